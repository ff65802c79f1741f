//! The program's side of the C table: from a library file to its plugins as traits.
//!
//! | file | what |
//! |---|---|
//! | `boundary` | all unsafe code: opening, reading what a library hands over, calling its functions |
//! | `float_state` | the processor's floating-point state, put back after a library's code |
//! | `handed_over` | which part of a library's structs this program can count on |
//! | `descriptor` | what a plugin declares of itself |
//! | `arguments` | what its functions are called with |
//! | `rig` | parts of a rig that a gear type hands over |
//!
//! What can be checked of a library is checked here: ABI version, sizes, null pointers, UTF-8,
//! counts. What cannot is whether its pointers lead where they say; that is why a new file is first
//! opened in a child process.

mod arguments;
mod boundary;
mod descriptor;
mod float_state;
mod handed_over;
mod rig;

use std::path::Path;

use endline_sdk::abi::table::AbiPlugin;

use super::info::{Hook, Refusal};

const REBUILD: &str = "rebuild the plugin against this version of endline-sdk or endline_plugin.h";
const TELL_AUTHOR: &str = "tell the plugin's author";

/// What a library holds.
#[derive(Clone)]
pub(super) struct Opened {
    /// What it says of itself: who made it, where its laws and figures come from; may be empty.
    pub about: String,
    /// Whether it runs in a process of its own.
    pub out_of_process: bool,
    /// Its plugins, and why each is not used that cannot be.
    pub hooks: Vec<Result<Hook, Refusal>>,
}

/// Opens a library, which stays mapped from then on, and gives its plugins. `named` is the file that the library is given as its
/// own place, where `file` is a copy.
pub(super) fn open(file: &Path, named: &Path) -> Result<Opened, Refusal> {
    let (about, plugins) = boundary::open(file, named)?;
    Ok(Opened {
        about,
        out_of_process: false,
        hooks: plugins.into_iter().map(|plugin| hook(plugin?)).collect(),
    })
}

fn hook(plugin: AbiPlugin) -> Result<Hook, Refusal> {
    let descriptor = descriptor::read(&plugin)?;
    let id = descriptor.id.to_string();
    boundary::hook(&plugin, descriptor).map_err(|refusal| Refusal { id: Some(id), ..refusal })
}
