//! Plugins that panic in each of their functions; the program must live.

use endline_sdk::{
    AttributeValue, Contacts, Descriptor, FrictionModel, FrictionResponse, GearType, HookError,
    MotionInput, MotionOutput, Rig, Site, WhaleMotion,
};

struct Panicking(Descriptor);

impl Panicking {
    fn new(id: &'static str) -> Self {
        let (version, name, help) =
            ("0.0.1".into(), "Panicking".into(), "Panics whenever it is called.".into());
        Self(Descriptor {
            id: id.into(),
            version,
            name,
            help,
            attributes: Vec::new(),
            state_len: 0,
            acts: Vec::new(),
        })
    }
}

#[expect(clippy::panic, reason = "the point of this plugin")]
fn fail() -> ! {
    panic!("the whale bit me")
}

impl WhaleMotion for Panicking {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn step(
        &self,
        _: &[f64],
        _: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        fail()
    }
}

impl FrictionModel for Panicking {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn respond(
        &self,
        _: &[f64],
        _: &Contacts<'_>,
        _: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        fail()
    }

    fn advance(&self, _: &[f64], _: &Contacts<'_>, _: &mut [f64]) -> Result<(), HookError> {
        fail()
    }
}

impl GearType for Panicking {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn build(&self, _: &[AttributeValue], _: &Site) -> Result<Rig, HookError> {
        fail()
    }
}

endline_sdk::export_plugin! {
    motion: Panicking::new("org.example.motion.panicking"),
    friction: Panicking::new("org.example.friction.panicking"),
    gear: Panicking::new("org.example.gear.panicking"),
}
