//! A plugin of another process as the program calls it: arguments go there, results come back.

use endline_sdk::{
    AttributeValue, Contacts, Descriptor, FrictionModel, FrictionResponse, GearAction, GearStep,
    GearType, HookError, MotionInput, MotionOutput, Rig, Site, WhaleMotion,
};

use super::Proxy;
use super::message::{Answer, Call};

impl WhaleMotion for Proxy {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let attributes = attributes.to_vec();
        let call = Call::Move { attributes, input: Box::new(input.into()), state: state.to_vec() };
        let Answer::Moved { output, state: floats } = self.ask(call)? else { return unasked() };
        fill(state, &floats)?;
        Ok(*output)
    }
}

impl FrictionModel for Proxy {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        let (attributes, contacts) = (attributes.to_vec(), Box::new(contacts.into()));
        let Answer::Responses(list) = self.ask(Call::Respond { attributes, contacts })? else {
            return unasked();
        };
        fill(out, &list)
    }

    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        let (attributes, contacts) = (attributes.to_vec(), Box::new(contacts.into()));
        let Answer::Floats(list) = self.ask(Call::Advance { attributes, contacts })? else {
            return unasked();
        };
        fill(out, &list)
    }
}

impl GearType for Proxy {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let call = Call::Build { attributes: attributes.to_vec(), site: *site };
        let Answer::Built(rig) = self.ask(call)? else { return unasked() };
        Ok(rig)
    }

    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let attributes = attributes.to_vec();
        let call = Call::Step { attributes, input: input.into(), state: state.to_vec() };
        let Answer::Acted { actions: taken, state: floats } = self.ask(call)? else {
            return unasked();
        };
        fill(state, &floats)?;
        actions.extend(taken);
        Ok(())
    }
}

/// Puts what a process gave where the program wants it.
fn fill<T: Copy>(out: &mut [T], given: &[T]) -> Result<(), HookError> {
    if out.len() != given.len() {
        return unasked();
    }
    out.copy_from_slice(given);
    Ok(())
}

fn unasked<T>() -> Result<T, HookError> {
    Err(HookError::new("its process answered what was not asked"))
}
