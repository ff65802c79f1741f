//! All unsafe code on the program's side of the plugin boundary: a library's pointers become safe
//! values here, and its functions are called.
#![expect(
    unsafe_code,
    reason = "one of the two sides of the plugin boundary: a library's pointers become safe values here"
)]

use std::borrow::Cow;
use std::ffi::c_void;
use std::path::Path;
use std::sync::Arc;

use endline_sdk::abi::table::*;
use endline_sdk::{
    AttributeValue, Contacts, Descriptor, FrictionModel, FrictionResponse, GearAction, GearStep,
    GearType, HookError, MotionInput, MotionOutput, Rig, Site, WhaleMotion,
};
use libloading::Library;

use super::super::info::{Hook, Refusal};
use super::float_state::guarded;
use super::{
    REBUILD, ReadText, SizedStruct, TELL_AUTHOR, raw_contacts, raw_gear_step, raw_motion_input,
    raw_values, rig_body, rig_joint, rig_line, rig_line_end, rig_link,
};

/// Most plugins that one library may hold; more is taken for a lie.
const MOST_PLUGINS: u32 = 1000;

/// Longest text of a plugin [bytes]; longer is taken for a lie.
const LONGEST_TEXT: usize = 65_536;

/// Room for a plugin's message [bytes].
const MESSAGE_ROOM: usize = 1024;

/// Most places along one line; more is taken for a lie.
const MOST_PLACES: usize = 1_000_000;

/// The problem of a library that sets the rounding mode or the treatment of subnormal numbers.
const CHANGED_FLOATS: &str =
    "it changed the processor's floating-point state, which decides how this program rounds";

const NOT_A_PLUGIN: &str = "only plugin libraries belong in this folder";

/// The description of a library, and the descriptor of each of its plugins.
type Contents = (String, Vec<Result<AbiPlugin, Refusal>>);

/// Opens a library, which stays mapped from then on; `named` is the path that it receives as its own.
pub(super) fn open(file: &Path, named: &Path) -> Result<Contents, Refusal> {
    let entry = read_entry(find_entry(file)?)?;
    initialise(&entry, named)?;
    let (factory, plugins) = plugins_of(&entry)?;
    // SAFETY: a descriptor begins with its size and lives as long as the library.
    let read = |plugin: &*const AbiPlugin| unsafe { known(*plugin, "descriptor of a plugin") };
    Ok((text(factory.about)?.into_owned(), plugins.iter().map(read).collect()))
}

fn find_entry(file: &Path) -> Result<*const AbiEntry, Refusal> {
    // SAFETY: opening runs the library's initialisers; a file that cannot stand that was refused by the child process.
    let (library, kept) = guarded(|| unsafe { Library::new(file) });
    let library = library.map_err(|error| {
        Refusal::new(format!("is not a library that can be opened: {error}"), NOT_A_PLUGIN)
    })?;
    // SAFETY: the symbol is only taken for an address here.
    let entry = unsafe { library.get::<*const AbiEntry>(ENTRY_NAME) }.map(|symbol| *symbol);
    std::mem::forget(library);
    if !kept {
        return Err(Refusal::new(CHANGED_FLOATS, TELL_AUTHOR));
    }
    entry.map_err(|_| {
        Refusal::new(
            format!("does not export `{ENTRY_NAME}`"),
            "build it with `export_plugin!` and the feature `entry`",
        )
    })
}

/// The entry: major version and size have the same offsets in every version of the ABI.
fn read_entry(entry: *const AbiEntry) -> Result<AbiEntry, Refusal> {
    // SAFETY: every version of the entry begins with these three numbers.
    let [major, minor, size] = unsafe { entry.cast::<[u32; 3]>().read_unaligned() };
    if major != ABI_MAJOR {
        let reason = format!(
            "was built for plugin ABI {major}.{minor}, but this program speaks {ABI_MAJOR}.{ABI_MINOR}"
        );
        return Err(Refusal::new(reason, REBUILD));
    }
    // SAFETY: of this major version, so it is as long as it says.
    unsafe { known_part(entry, size, "entry") }
}

/// The known part of a struct of a library: zero, and for a function none, where an older one lacks it.
///
/// # Safety
/// `given` leads to `size` bytes, and `T` is made of numbers, pointers and functions that may be null.
unsafe fn known_part<T: SizedStruct>(given: *const T, size: u32, what: &str) -> Result<T, Refusal> {
    let size = size as usize;
    if size < T::LEAST {
        return Err(Refusal::new(
            format!("its {what} is truncated: {size} bytes where {} are needed", T::LEAST),
            REBUILD,
        ));
    }
    let mut known = std::mem::MaybeUninit::<T>::zeroed();
    // SAFETY: the caller's promise; all zeros is a value of such a struct.
    unsafe {
        std::ptr::copy_nonoverlapping(
            given.cast::<u8>(),
            known.as_mut_ptr().cast(),
            size.min(size_of::<T>()),
        );
        Ok(known.assume_init())
    }
}

/// The known part of a struct that begins with its size; null is refused.
///
/// # Safety
/// `given` is null or leads to as many bytes as it begins with, and `T` is as in [`known_part`].
unsafe fn known<T: SizedStruct>(given: *const T, what: &str) -> Result<T, Refusal> {
    // SAFETY: the caller's promise.
    unsafe {
        let size = given.cast::<u32>().as_ref().ok_or_else(|| missing(what))?;
        known_part(given, *size, what)
    }
}

fn missing(what: &str) -> Refusal {
    Refusal::new(format!("its {what} is missing"), REBUILD)
}

fn initialise(entry: &AbiEntry, file: &Path) -> Result<(), Refusal> {
    let init = entry.init.ok_or_else(|| missing("function `init`"))?;
    let path = file.to_string_lossy();
    // SAFETY: called as the table says.
    call(|message| unsafe { init(AbiText::of(&path), message) })
        .map_err(|error| Refusal::new(format!("does not start: {error}"), TELL_AUTHOR))
}

fn plugins_of(entry: &AbiEntry) -> Result<(AbiFactory, &'static [*const AbiPlugin]), Refusal> {
    let get_factory = entry.get_factory.ok_or_else(|| missing("function `get_factory`"))?;
    // SAFETY: the factory and its list live as long as the library, which is never unmapped.
    unsafe {
        let factory = known(
            get_factory(AbiText::of(FACTORY_ID)).cast::<AbiFactory>(),
            &format!("factory `{FACTORY_ID}`"),
        )?;
        let (count, plugins) = (factory.plugin_count, factory.plugins);
        if count == 0 || count > MOST_PLUGINS || plugins.is_null() {
            return Err(Refusal::new(format!("its factory lists {count} plugins"), TELL_AUTHOR));
        }
        Ok((factory, std::slice::from_raw_parts(plugins, count as usize)))
    }
}

/// A plugin as its trait, by its table of functions.
pub(super) fn hook(plugin: &AbiPlugin, descriptor: Descriptor) -> Result<Hook, Refusal> {
    Ok(match plugin.kind {
        KIND_MOTION => {
            let table: AbiMotion = read_table(plugin)?;
            Hook::Motion(Arc::new(Loaded {
                descriptor,
                context: plugin.context,
                calls: Motion { step: needed(table.step)? },
            }))
        }
        KIND_FRICTION => {
            let table: AbiFriction = read_table(plugin)?;
            let calls =
                Friction { respond: needed(table.respond)?, advance: needed(table.advance)? };
            Hook::Friction(Arc::new(Loaded { descriptor, context: plugin.context, calls }))
        }
        KIND_GEAR => {
            let table: AbiGear = read_table(plugin)?;
            let calls = Gear { build: needed(table.build)?, step: table.step };
            Hook::Gear(Arc::new(Loaded { descriptor, context: plugin.context, calls }))
        }
        other => {
            return Err(Refusal::new(
                format!("its kind {other} is not known to this program"),
                REBUILD,
            ));
        }
    })
}

fn read_table<T: SizedStruct>(plugin: &AbiPlugin) -> Result<T, Refusal> {
    // SAFETY: a table begins with its size, is of the kind the descriptor says, and lives as long as the library.
    unsafe { known(plugin.table.cast::<T>(), "table of functions") }
}

fn needed<F>(function: Option<F>) -> Result<F, Refusal> {
    function.ok_or_else(|| missing("table's function"))
}

/// Attributes and acts that a plugin declares.
pub(super) fn declarations(plugin: &AbiPlugin) -> (&[AbiAttribute], &[AbiAct]) {
    // SAFETY: attributes and acts live as long as the library.
    unsafe {
        (array(plugin.attributes, plugin.attribute_count), array(plugin.acts, plugin.act_count))
    }
}

/// A text of a library, copied.
pub(super) fn text(raw: AbiText) -> Result<Cow<'static, str>, Refusal> {
    if raw.length > LONGEST_TEXT {
        return Err(Refusal::new(
            format!("one of its texts claims {} bytes", raw.length),
            TELL_AUTHOR,
        ));
    }
    // SAFETY: text of a descriptor lives as long as the library; it is copied all the same.
    let bytes = unsafe { array(raw.text.cast::<u8>(), raw.length) };
    let text = std::str::from_utf8(bytes)
        .map_err(|_| Refusal::new("one of its texts is not UTF-8", TELL_AUTHOR))?;
    Ok(Cow::Owned(text.to_owned()))
}

/// A plugin of a library: its own context and its functions.
struct Loaded<F> {
    descriptor: Descriptor,
    context: *const c_void,
    calls: F,
}

// SAFETY: the table's contract has every function of a plugin callable from any thread, several at once.
unsafe impl<F> Send for Loaded<F> {}
// SAFETY: as above.
unsafe impl<F> Sync for Loaded<F> {}

type Step<A, I, O> = unsafe extern "C" fn(
    *const c_void,
    *const A,
    usize,
    *const I,
    *mut f64,
    usize,
    O,
    *mut AbiMessage,
) -> i32;
type Pass<A, I, O> =
    unsafe extern "C" fn(*const c_void, *const A, usize, *const I, O, *mut AbiMessage) -> i32;

struct Motion {
    step: Step<f64, AbiMotionInput, *mut MotionOutput>,
}

struct Friction {
    respond: Pass<f64, AbiContacts, *mut FrictionResponse>,
    advance: Pass<f64, AbiContacts, *mut f64>,
}

struct Gear {
    build: Pass<AbiValue, Site, *const AbiRigHost>,
    step: Option<Step<AbiValue, AbiGearStep, *const AbiActionHost>>,
}

impl WhaleMotion for Loaded<Motion> {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let raw = raw_motion_input(input);
        let (count, floats) = (attributes.len(), state.len());
        let mut out = MotionOutput::default();
        // SAFETY: pointers and lengths of live slices.
        call(|message| unsafe {
            (self.calls.step)(
                self.context,
                attributes.as_ptr(),
                count,
                &raw,
                state.as_mut_ptr(),
                floats,
                &mut out,
                message,
            )
        })?;
        Ok(out)
    }
}

impl FrictionModel for Loaded<Friction> {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        let raw = raw_contacts(contacts, self.descriptor.state_len, out.len(), contacts.len())?;
        let (respond, count) = (self.calls.respond, attributes.len());
        // SAFETY: pointers and lengths of live slices; `raw_contacts` saw that they agree.
        call(|message| unsafe {
            respond(self.context, attributes.as_ptr(), count, &raw, out.as_mut_ptr(), message)
        })
    }

    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        let floats = self.descriptor.state_len;
        let raw = raw_contacts(contacts, floats, out.len(), contacts.len() * floats)?;
        let (advance, count) = (self.calls.advance, attributes.len());
        // SAFETY: as in `respond`.
        call(|message| unsafe {
            advance(self.context, attributes.as_ptr(), count, &raw, out.as_mut_ptr(), message)
        })
    }
}

impl GearType for Loaded<Gear> {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let values = raw_values(&self.descriptor, attributes);
        let mut rig = Rig::default();
        let host = AbiRigHost {
            struct_size: size_of::<AbiRigHost>() as u32,
            host: (&raw mut rig).cast(),
            add_body: Some(add_body),
            add_joint: Some(add_joint),
            add_line: Some(add_line),
            add_link: Some(add_link),
            lay_line: Some(lay_line),
        };
        let build = self.calls.build;
        // SAFETY: pointers and lengths of live values; `host` lives through the call.
        call(|message| unsafe {
            build(self.context, values.as_ptr(), values.len(), site, &host, message)
        })?;
        Ok(rig)
    }

    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let Some(step) = self.calls.step else { return Ok(()) };
        let (values, floats) = (raw_values(&self.descriptor, attributes), state.len());
        let raw = raw_gear_step(input);
        let host = AbiActionHost {
            struct_size: size_of::<AbiActionHost>() as u32,
            host: (&raw mut *actions).cast(),
            cut_line: Some(cut_line),
            release_link: Some(release_link),
        };
        // SAFETY: as in `build`.
        call(|message| unsafe {
            step(
                self.context,
                values.as_ptr(),
                values.len(),
                &raw,
                state.as_mut_ptr(),
                floats,
                &host,
                message,
            )
        })
    }
}

/// Adds a part of a plugin to the rig behind `host`.
///
/// # Safety
/// `host` is the `Rig` of [`Loaded::build`], `part` null or a live struct.
unsafe fn add<T>(
    host: *mut c_void,
    part: *const T,
    add_part: fn(&mut Rig, &T, ReadText) -> Option<()>,
) -> i32 {
    // SAFETY: the caller's promise.
    let taken = unsafe { host.cast::<Rig>().as_mut().zip(part.as_ref()) }
        .and_then(|(rig, part)| add_part(rig, part, owned));
    if taken.is_some() { STATUS_OK } else { STATUS_ERROR }
}

unsafe extern "C" fn add_body(host: *mut c_void, body: *const AbiBody) -> i32 {
    // SAFETY: `host` is what the table's user was handed.
    unsafe { add(host, body, rig_body) }
}

unsafe extern "C" fn add_joint(host: *mut c_void, joint: *const AbiJoint) -> i32 {
    // SAFETY: as in `add_body`.
    unsafe { add(host, joint, rig_joint) }
}

unsafe extern "C" fn add_line(host: *mut c_void, line: *const AbiLine) -> i32 {
    // SAFETY: as in `add_body`.
    unsafe { add(host, line, rig_line) }
}

unsafe extern "C" fn add_link(host: *mut c_void, link: *const AbiLink) -> i32 {
    // SAFETY: as in `add_body`.
    unsafe { add(host, link, rig_link) }
}

/// # Safety
/// As [`add`], for the rig's lines and `count` places.
unsafe extern "C" fn lay_line(
    host: *mut c_void,
    line: AbiText,
    places_m: *const [f64; 3],
    count: usize,
) -> i32 {
    // SAFETY: the caller's promise.
    let (rig, places) =
        unsafe { (host.cast::<Rig>().as_mut(), array(places_m, count.min(MOST_PLACES))) };
    let known = rig
        .zip(owned(line))
        .and_then(|(rig, id)| rig.lines.iter_mut().find(|known| known.id == id));
    match known {
        Some(line) if count <= MOST_PLACES => {
            line.laid_m = places.to_vec();
            STATUS_OK
        }
        _ => STATUS_ERROR,
    }
}

/// # Safety
/// `host` is the list of actions of [`Loaded::step`].
unsafe extern "C" fn cut_line(host: *mut c_void, line: u32, end: u32) -> i32 {
    let action = rig_line_end(end).map(|end| GearAction::CutLine { line, end });
    // SAFETY: the caller's promise.
    unsafe { push_action(host, action) }
}

/// # Safety
/// As [`cut_line`].
unsafe extern "C" fn release_link(host: *mut c_void, link: u32) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { push_action(host, Some(GearAction::ReleaseLink { link })) }
}

/// # Safety
/// As [`cut_line`].
unsafe fn push_action(host: *mut c_void, action: Option<GearAction>) -> i32 {
    // SAFETY: the caller's promise.
    let Some((actions, action)) = unsafe { host.cast::<Vec<GearAction>>().as_mut() }.zip(action)
    else {
        return STATUS_ERROR;
    };
    actions.push(action);
    STATUS_OK
}

fn owned(raw: AbiText) -> Option<String> {
    text(raw).ok().map(Cow::into_owned)
}

/// Calls a plugin with room for a message; a status other than [`STATUS_OK`] becomes an error with it.
fn call(function: impl FnOnce(*mut AbiMessage) -> i32) -> Result<(), HookError> {
    let mut room = [0_u8; MESSAGE_ROOM];
    let mut message = AbiMessage::over(&mut room);
    let (status, kept) = guarded(|| function(&mut message));
    if !kept {
        return Err(HookError::new(CHANGED_FLOATS));
    }
    if status == STATUS_OK {
        return Ok(());
    }
    let length = message.length.min(MESSAGE_ROOM);
    let said = String::from_utf8_lossy(&room[..length]).into_owned();
    Err(HookError::new(match status {
        STATUS_ERROR => said,
        STATUS_CRASH => format!("it failed inside (panicked): {said}"),
        other => format!("it gave the unknown status {other}: {said}"),
    }))
}

/// # Safety
/// `count` values lie at `first`, or it is null; they live as long as the caller uses them.
unsafe fn array<'a, T>(first: *const T, count: usize) -> &'a [T] {
    // SAFETY: the caller's promise.
    if first.is_null() { &[] } else { unsafe { std::slice::from_raw_parts(first, count) } }
}
