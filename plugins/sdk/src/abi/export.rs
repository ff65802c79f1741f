//! The plugin's side of the C table: from traits to function pointers.
//!
//! Everything here runs inside a plugin library. Each function catches a panic and gives it back
//! as [`STATUS_CRASH`] with its message, so that nothing unwinds into the program; that needs the
//! plugin to be built with `panic = "unwind"`, Rust's default.
#![expect(
    unsafe_code,
    reason = "one of the two sides of the plugin boundary: raw pointers from the program become slices here"
)]

use std::any::Any;
use std::ffi::c_void;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;

use super::table::*;
use crate::friction::{Contacts, FrictionModel, FrictionResponse};
use crate::gear::{
    BodyKind, GearAction, GearStep, GearType, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink,
    Site,
};
use crate::hook::{Act, Attribute, AttributeKind, AttributeValue, Descriptor, HookError};
use crate::motion::{MotionInput, MotionOutput, WhaleMotion};
use crate::whale::BodyPart;

/// Exports plugins from a library crate, where its feature `entry` is on.
///
/// ```text
/// endline_sdk::export_plugin! { motion: Swim::new(), friction: Coulomb::new(), gear: Single::new() }
/// ```
///
/// Any number of plugins, each after its kind: `motion`, `friction` or `gear`. First may stand what the library says of itself,
/// as in `about: "A. Author 2026, after Smith 1999";`. Without the feature nothing is generated, so that several plugin crates
/// link into one binary.
#[macro_export]
macro_rules! export_plugin {
    ($($kind:ident: $plugin:expr),+ $(,)?) => {
        $crate::export_plugin! { about: ""; $($kind: $plugin),+ }
    };
    (about: $about:expr; $($kind:ident: $plugin:expr),+ $(,)?) => {
        #[cfg(feature = "entry")]
        mod endline_plugin_export {
            #![allow(unsafe_code, reason = "an exported symbol is unsafe to name; all work is done in endline_sdk::abi::export")]
            use super::*;
            use $crate::abi::export::{Exported, Factory, factory, init};
            use $crate::abi::table::{ABI_MAJOR, ABI_MINOR, AbiEntry, AbiMessage, AbiText};

            static FACTORY: ::std::sync::OnceLock<Factory> = ::std::sync::OnceLock::new();

            extern "C" fn init_library(_path: AbiText, message: *mut AbiMessage) -> i32 {
                init(&FACTORY, || ::std::vec![$(Exported::$kind($plugin)),+], $about, message)
            }

            extern "C" fn get_factory(id: AbiText) -> *const ::std::ffi::c_void {
                factory(&FACTORY, id)
            }

            /// Where the program enters this library.
            #[unsafe(no_mangle)]
            #[allow(non_upper_case_globals, reason = "the name is part of the ABI")]
            pub static endline_plugin_entry: AbiEntry = AbiEntry {
                abi_major: ABI_MAJOR,
                abi_minor: ABI_MINOR,
                struct_size: ::std::mem::size_of::<AbiEntry>() as u32,
                init: Some(init_library),
                deinit: None,
                get_factory: Some(get_factory),
            };
        }
    };
}

/// One plugin to export.
pub enum Exported {
    /// A whale motion.
    Motion(Box<dyn WhaleMotion>),
    /// A friction model.
    Friction(Box<dyn FrictionModel>),
    /// A gear type.
    Gear(Box<dyn GearType>),
}

impl Exported {
    /// A whale motion.
    pub fn motion(plugin: impl WhaleMotion + 'static) -> Self {
        Self::Motion(Box::new(plugin))
    }

    /// A friction model.
    pub fn friction(plugin: impl FrictionModel + 'static) -> Self {
        Self::Friction(Box::new(plugin))
    }

    /// A gear type.
    pub fn gear(plugin: impl GearType + 'static) -> Self {
        Self::Gear(Box::new(plugin))
    }
}

/// The factory of a library and all it points at; made once, never freed.
pub struct Factory(AbiFactory);

// SAFETY: the pointers lead to leaked memory that nobody writes to after it is made, and the
// traits behind `context` are `Send + Sync`.
unsafe impl Send for Factory {}
// SAFETY: as above.
unsafe impl Sync for Factory {}

/// Makes the factory; a panic in a plugin's constructor becomes a status with its message.
pub fn init(
    store: &OnceLock<Factory>,
    plugins: impl FnOnce() -> Vec<Exported>,
    about: &'static str,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        store.get_or_init(|| make_factory(plugins(), about));
        Ok(())
    })
}

/// The factory, where it was made and the id is its own; null otherwise.
pub fn factory(store: &OnceLock<Factory>, id: AbiText) -> *const c_void {
    // SAFETY: the program hands over text that lives through this call.
    let asked = unsafe { text(id) };
    match store.get() {
        Some(factory) if asked == FACTORY_ID => (&raw const factory.0).cast(),
        _ => std::ptr::null(),
    }
}

fn make_factory(plugins: Vec<Exported>, about: &'static str) -> Factory {
    let pointers: Vec<*const AbiPlugin> = plugins
        .into_iter()
        .map(|plugin| &raw const *Box::leak(Box::new(make_plugin(plugin))))
        .collect();
    let pointers = Vec::leak(pointers);
    Factory(AbiFactory {
        struct_size: size::<AbiFactory>(),
        plugin_count: pointers.len() as u32,
        plugins: pointers.as_ptr(),
        about: AbiText::of(about),
    })
}

fn make_plugin(plugin: Exported) -> AbiPlugin {
    match plugin {
        Exported::Motion(plugin) => {
            let plugin = Box::leak(Box::new(plugin));
            describe(
                KIND_MOTION,
                plugin.descriptor(),
                (&raw const *plugin).cast(),
                (&raw const MOTION).cast(),
            )
        }
        Exported::Friction(plugin) => {
            let plugin = Box::leak(Box::new(plugin));
            describe(
                KIND_FRICTION,
                plugin.descriptor(),
                (&raw const *plugin).cast(),
                (&raw const FRICTION).cast(),
            )
        }
        Exported::Gear(plugin) => {
            let plugin = Box::leak(Box::new(plugin));
            describe(
                KIND_GEAR,
                plugin.descriptor(),
                (&raw const *plugin).cast(),
                (&raw const GEAR).cast(),
            )
        }
    }
}

fn describe(
    kind: u32,
    descriptor: &'static Descriptor,
    context: *const c_void,
    table: *const c_void,
) -> AbiPlugin {
    let attributes = Vec::leak(descriptor.attributes.iter().map(describe_attribute).collect());
    let acts = Vec::leak(descriptor.acts.iter().map(describe_act).collect());
    AbiPlugin {
        struct_size: size::<AbiPlugin>(),
        kind,
        id: AbiText::of(&descriptor.id),
        version: AbiText::of(&descriptor.version),
        name: AbiText::of(&descriptor.name),
        help: AbiText::of(&descriptor.help),
        attributes: attributes.as_ptr(),
        attribute_count: attributes.len(),
        state_len: descriptor.state_len,
        context,
        table,
        acts: acts.as_ptr(),
        act_count: acts.len(),
    }
}

fn describe_act(act: &'static Act) -> AbiAct {
    AbiAct { id: AbiText::of(&act.id), name: AbiText::of(&act.name), help: AbiText::of(&act.help) }
}

fn describe_attribute(attribute: &'static Attribute) -> AbiAttribute {
    let mut described = AbiAttribute {
        key: AbiText::of(&attribute.key),
        unit: AbiText::of(&attribute.unit),
        help: AbiText::of(&attribute.help),
        kind: ATTRIBUTE_NUMBER,
        least: 0.0,
        greatest: 0.0,
        default_number: 0.0,
        library: AbiText::of(""),
        default_item: AbiText::of(""),
    };
    match &attribute.kind {
        AttributeKind::Number { min, max, default } => {
            (described.least, described.greatest, described.default_number) =
                (*min, *max, *default);
        }
        AttributeKind::Count { min, max, default } => {
            described.kind = ATTRIBUTE_COUNT;
            (described.least, described.greatest, described.default_number) =
                (f64::from(*min), f64::from(*max), f64::from(*default));
        }
        AttributeKind::Choice { words, default } => {
            described.kind = ATTRIBUTE_CHOICE;
            let words: &'static str = String::leak(words.join("|"));
            (described.library, described.default_item) =
                (AbiText::of(words), AbiText::of(default));
        }
        AttributeKind::Item { library, default } => {
            described.kind = ATTRIBUTE_ITEM;
            (described.library, described.default_item) =
                (AbiText::of(library), AbiText::of(default));
        }
    }
    described
}

static MOTION: AbiMotion = AbiMotion { struct_size: size::<AbiMotion>(), step: Some(motion_step) };
static FRICTION: AbiFriction = AbiFriction {
    struct_size: size::<AbiFriction>(),
    respond: Some(friction_respond),
    advance: Some(friction_advance),
};
static GEAR: AbiGear =
    AbiGear { struct_size: size::<AbiGear>(), build: Some(gear_build), step: Some(gear_step) };

/// # Safety
/// As [`AbiMotion::step`] promises: arrays of the lengths given, `context` from [`make_plugin`].
unsafe extern "C" fn motion_step(
    context: *const c_void,
    attributes: *const f64,
    attribute_count: usize,
    input: *const AbiMotionInput,
    state: *mut f64,
    state_len: usize,
    out: *mut MotionOutput,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: the caller's promise.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn WhaleMotion>>(), known_part(input));
            let parts = |what: &str, of: *const f64| {
                let given = array(of, raw.body_part_count);
                <&[f64; BodyPart::ALL.len()]>::try_from(given).map_err(|_| {
                    HookError::new(format!(
                        "expected {what} of {} body parts, got {}",
                        BodyPart::ALL.len(),
                        given.len()
                    ))
                })
            };
            let (force, port) =
                (parts("forces", raw.contact_force_n)?, parts("places", raw.contact_port_m)?);
            let input = motion_input(&raw, force, port);
            *out = plugin.step(
                array(attributes, attribute_count),
                &input,
                array_mut(state, state_len),
            )?;
        }
        Ok(())
    })
}

fn motion_input<'a>(
    raw: &AbiMotionInput,
    contact_force_n: &'a [f64; BodyPart::ALL.len()],
    contact_port_m: &'a [f64; BodyPart::ALL.len()],
) -> MotionInput<'a> {
    MotionInput {
        time_s: raw.time_s,
        dt_s: raw.dt_s,
        length_m: raw.length_m,
        speed_m_s: raw.speed_m_s,
        position_m: raw.position_m,
        orientation: raw.orientation,
        controls: raw.controls,
        contact_force_n,
        contact_port_m,
    }
}

/// # Safety
/// As [`AbiFriction::respond`] promises.
unsafe extern "C" fn friction_respond(
    context: *const c_void,
    attributes: *const f64,
    attribute_count: usize,
    contacts: *const AbiContacts,
    out: *mut FrictionResponse,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: the caller's promise.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn FrictionModel>>(), known_part(contacts));
            plugin.respond(
                array(attributes, attribute_count),
                &friction_contacts(&raw),
                array_mut(out, raw.count),
            )
        }
    })
}

/// # Safety
/// As [`AbiFriction::advance`] promises.
unsafe extern "C" fn friction_advance(
    context: *const c_void,
    attributes: *const f64,
    attribute_count: usize,
    contacts: *const AbiContacts,
    out: *mut f64,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: the caller's promise.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn FrictionModel>>(), known_part(contacts));
            let out = array_mut(out, raw.count * raw.state_len);
            plugin.advance(array(attributes, attribute_count), &friction_contacts(&raw), out)
        }
    })
}

/// # Safety
/// The arrays have the lengths that `raw` says.
unsafe fn friction_contacts(raw: &AbiContacts) -> Contacts<'_> {
    // SAFETY: the caller's promise.
    unsafe {
        Contacts {
            dt_s: raw.dt_s,
            normal_force_n: array(raw.normal_force_n, raw.count),
            normal: array(raw.normal, raw.count),
            grain: array(raw.grain, raw.count),
            along: array(raw.along, raw.count),
            slip_m: array(raw.slip_m, raw.count),
            length_m: array(raw.length_m, raw.count),
            coefficient: array(raw.coefficient, raw.count),
            region: array(raw.region, raw.count),
            rope: array(raw.rope, raw.count),
            state: array(raw.state, raw.count * raw.state_len),
        }
    }
}

/// # Safety
/// As [`AbiGear::build`] promises.
unsafe extern "C" fn gear_build(
    context: *const c_void,
    values: *const AbiValue,
    value_count: usize,
    site: *const Site,
    rig: *const AbiRigHost,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: the caller's promise.
        unsafe {
            let plugin = &*context.cast::<Box<dyn GearType>>();
            let built = plugin.build(&attribute_values(array(values, value_count)), &*site)?;
            hand_over(&built, &known_part(rig))
        }
    })
}

/// # Safety
/// As [`AbiGear::step`] promises.
unsafe extern "C" fn gear_step(
    context: *const c_void,
    values: *const AbiValue,
    value_count: usize,
    input: *const AbiGearStep,
    state: *mut f64,
    state_len: usize,
    actions: *const AbiActionHost,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: the caller's promise.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn GearType>>(), known_part(input));
            let step = GearStep {
                time_s: raw.time_s,
                dt_s: raw.dt_s,
                end_tension_n: array(raw.end_tension_n, raw.line_count),
            };
            let mut wanted = Vec::new();
            plugin.step(
                &attribute_values(array(values, value_count)),
                &step,
                array_mut(state, state_len),
                &mut wanted,
            )?;
            let host = known_part(actions);
            wanted.iter().try_for_each(|action| act(action, &host))
        }
    })
}

/// # Safety
/// The values' texts live through this call.
unsafe fn attribute_values(values: &[AbiValue]) -> Vec<AttributeValue> {
    let value = |value: &AbiValue| match value.kind {
        // SAFETY: the caller's promise.
        ATTRIBUTE_ITEM => AttributeValue::Item(unsafe { text(value.item) }.into_owned()),
        // SAFETY: the caller's promise.
        ATTRIBUTE_CHOICE => AttributeValue::Choice(unsafe { text(value.item) }.into_owned()),
        _ => AttributeValue::Number(value.number),
    };
    values.iter().map(value).collect()
}

/// A struct of the program's; what a program of an older minor version lacks is zero, a function then none.
///
/// # Safety
/// `given` leads to a struct of as many bytes as its first field says, and `T` is made of numbers, pointers and
/// functions that may be null.
unsafe fn known_part<T: Copy>(given: *const T) -> T {
    let mut known = std::mem::MaybeUninit::<T>::zeroed();
    // SAFETY: the caller's promise; all zeros is a value of such a struct.
    unsafe {
        let bytes = (given.cast::<u32>().read() as usize).min(size_of::<T>());
        std::ptr::copy_nonoverlapping(given.cast::<u8>(), known.as_mut_ptr().cast(), bytes);
        known.assume_init()
    }
}

/// Gives a rig to the program, part by part.
///
/// # Safety
/// `host` holds the program's functions.
unsafe fn hand_over(rig: &Rig, host: &AbiRigHost) -> Result<(), HookError> {
    // SAFETY: each function is called as the table says, with structs that live through the call.
    unsafe {
        for body in &rig.bodies {
            taken(host.add_body.map(|add| add(host.host, &raw_body(body))))?;
        }
        for joint in &rig.joints {
            taken(host.add_joint.map(|add| add(host.host, &raw_joint(joint))))?;
        }
        for line in &rig.lines {
            taken(host.add_line.map(|add| add(host.host, &raw_line(line))))?;
            let laid = &line.laid_m;
            if !laid.is_empty() {
                taken(
                    host.lay_line.map(|lay| {
                        lay(host.host, AbiText::of(&line.id), laid.as_ptr(), laid.len())
                    }),
                )?;
            }
        }
        for link in &rig.links {
            taken(host.add_link.map(|add| add(host.host, &raw_link(link))))?;
        }
    }
    Ok(())
}

/// # Safety
/// `host` holds the program's functions.
unsafe fn act(action: &GearAction, host: &AbiActionHost) -> Result<(), HookError> {
    // SAFETY: each function is called as the table says.
    taken(unsafe {
        match *action {
            GearAction::CutLine { line, end } => {
                host.cut_line.map(|cut| cut(host.host, line, end as u32))
            }
            GearAction::ReleaseLink { link } => {
                host.release_link.map(|release| release(host.host, link))
            }
        }
    })
}

fn taken(status: Option<i32>) -> Result<(), HookError> {
    if status == Some(STATUS_OK) {
        Ok(())
    } else {
        Err(HookError::new("the program did not take what the gear type gave"))
    }
}

fn raw_body(body: &RigBody) -> AbiBody {
    let kind = match body.kind {
        BodyKind::Trap => BODY_TRAP,
        BodyKind::Buoy => BODY_BUOY,
        BodyKind::Anchor => BODY_ANCHOR,
    };
    AbiBody {
        id: AbiText::of(&body.id),
        kind,
        item: AbiText::of(&body.item),
        position_m: body.position_m,
    }
}

fn raw_joint(joint: &RigJoint) -> AbiJoint {
    AbiJoint { id: AbiText::of(&joint.id), position_m: joint.position_m }
}

fn raw_line(line: &RigLine) -> AbiLine {
    AbiLine {
        id: AbiText::of(&line.id),
        rope: AbiText::of(&line.rope),
        from: raw_end(&line.from),
        to: raw_end(&line.to),
        length_m: line.length_m,
    }
}

fn raw_end(end: &RigEnd) -> AbiRigEnd {
    match end {
        RigEnd::Body(id) => AbiRigEnd { at: AT_BODY, id: AbiText::of(id) },
        RigEnd::Joint(id) => AbiRigEnd { at: AT_JOINT, id: AbiText::of(id) },
    }
}

fn raw_link(link: &RigLink) -> AbiLink {
    AbiLink {
        id: AbiText::of(&link.id),
        item: AbiText::of(&link.item),
        line: AbiText::of(&link.line),
        end: link.end as u32,
    }
}

/// Runs a hook: its error or its panic becomes a status with a message.
fn guarded(message: *mut AbiMessage, work: impl FnOnce() -> Result<(), HookError>) -> i32 {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => STATUS_OK,
        Ok(Err(error)) => {
            say(message, &error.message);
            STATUS_ERROR
        }
        Err(payload) => {
            say(message, panic_text(payload.as_ref()));
            std::mem::forget(payload); // its drop might panic in turn
            STATUS_CRASH
        }
    }
}

fn panic_text(payload: &(dyn Any + Send)) -> &str {
    let known = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    known.unwrap_or("a panic without a message")
}

/// Writes a message into the caller's buffer, cut at a character's end where it is too long.
fn say(message: *mut AbiMessage, words: &str) {
    // SAFETY: the caller hands null or a buffer of `capacity` bytes that is its own alone.
    unsafe {
        let Some(message) = message.as_mut() else { return };
        let length = words.floor_char_boundary(message.capacity);
        std::ptr::copy_nonoverlapping(words.as_ptr(), message.text.cast(), length);
        message.length = length;
    }
}

/// # Safety
/// The text lives as long as the caller uses it.
unsafe fn text<'a>(raw: AbiText) -> std::borrow::Cow<'a, str> {
    // SAFETY: the caller's promise.
    String::from_utf8_lossy(unsafe { array(raw.text.cast(), raw.length) })
}

/// # Safety
/// `count` values lie at `first`, or it is null; they live as long as the caller uses them.
unsafe fn array<'a, T>(first: *const T, count: usize) -> &'a [T] {
    // SAFETY: the caller's promise.
    if first.is_null() { &[] } else { unsafe { std::slice::from_raw_parts(first, count) } }
}

/// # Safety
/// As [`array`], and nobody else uses them meanwhile.
unsafe fn array_mut<'a, T>(first: *mut T, count: usize) -> &'a mut [T] {
    // SAFETY: the caller's promise.
    if first.is_null() { &mut [] } else { unsafe { std::slice::from_raw_parts_mut(first, count) } }
}

const fn size<T>() -> u32 {
    size_of::<T>() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    unsafe extern "C" fn lay(_: *mut c_void, _: AbiText, _: *const [f64; 3], _: usize) -> i32 {
        STATUS_OK
    }

    #[test]
    fn what_a_program_of_an_older_minor_version_lacks_is_none() {
        let whole = AbiRigHost {
            struct_size: size::<AbiRigHost>(),
            host: std::ptr::null_mut(),
            add_body: None,
            add_joint: None,
            add_line: None,
            add_link: None,
            lay_line: Some(lay),
        };
        let older =
            AbiRigHost { struct_size: std::mem::offset_of!(AbiRigHost, lay_line) as u32, ..whole };
        // SAFETY: both are whole structs; the second says that it is shorter.
        let (whole, older) = unsafe { (known_part(&whole), known_part(&older)) };
        assert!(whole.lay_line.is_some() && older.lay_line.is_none());
    }
}
