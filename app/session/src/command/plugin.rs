//! Commands that load, check and use plugins.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::info::{Choice, Make, loads_plugins, require};
use super::{Command, Info};
use crate::workbench::Workbench;

/// An action on plugins.
#[derive(Clone, Debug, PartialEq, Eq, EnumDiscriminants)]
#[strum_discriminants(name(PluginVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "plugin.", serialize_all = "kebab-case"))]
pub enum PluginAction {
    /// Loads the plugins again. A plugin that was rebuilt counts from the next run on.
    #[strum_discriminants(strum(message = "Reload plugins"))]
    Reload,
    /// Lets a plugin library be opened that is new, or has changed since it was allowed.
    #[strum_discriminants(strum(message = "Allow plugin"))]
    Allow {
        /// The library.
        file: PathBuf,
        /// The hash, hexadecimal.
        hash: String,
    },
    /// Switches a plugin on or off.
    #[strum_discriminants(strum(message = "Switch"))]
    Switch {
        /// Its id.
        id: String,
        /// Whether it is on from now.
        on: bool,
    },
    /// Tries a plugin file in a process of its own and reports what is wrong with it.
    #[strum_discriminants(strum(message = "Check a plugin file"))]
    Check(PathBuf),
    /// Puts a motion or a law of friction into the scenario.
    #[strum_discriminants(strum(message = "Use plugin"))]
    Use(String),
}

/// The actions on plugins, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::plain(PluginAction::Reload).only_if(loads_plugins),
        Info::of(PluginVerb::Allow, Make::Choices(waiting)).only_if(|workbench| {
            let waiting = workbench.plugins.waiting().next().is_some();
            require(waiting, "no plugin waits to be allowed")
        }),
        Info::of(PluginVerb::Switch, Make::Choices(switches)).only_if(|workbench| {
            loads_plugins(workbench)?;
            require(!workbench.plugins.every().is_empty(), "there are no plugins")
        }),
        Info::of(PluginVerb::Use, Make::Choices(usable)).only_if(|workbench| {
            let usable = !workbench.usable_plugins().is_empty();
            require(usable, "no plugin that the scenario does not use already")
        }),
        Info::values(PluginVerb::Check, "file"),
    ]
}

fn waiting(workbench: &Workbench) -> Vec<Choice<Command>> {
    let choice = |(file, ask): (&PathBuf, &crate::plugins::Ask)| {
        let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
        let action = PluginAction::Allow { file: file.clone(), hash: ask.hash.clone() };
        Choice::new(name.unwrap_or_default(), Command::Plugin(action))
    };
    workbench.plugins.waiting().map(choice).collect()
}

fn switches(workbench: &Workbench) -> Vec<Choice<Command>> {
    let every = workbench.plugins.every().into_iter();
    every
        .map(|plugin| {
            let name = format!("{} {}", if plugin.on { "off" } else { "on" }, plugin.info.name);
            let action = PluginAction::Switch { id: plugin.info.id, on: !plugin.on };
            Choice::new(name, Command::Plugin(action))
        })
        .collect()
}

fn usable(workbench: &Workbench) -> Vec<Choice<Command>> {
    let usable = workbench.usable_plugins().into_iter();
    usable.map(|info| Choice::new(info.name, Command::Plugin(PluginAction::Use(info.id)))).collect()
}

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: PluginAction) -> Result<(), String> {
    match action {
        PluginAction::Reload => workbench.reload_plugins(),
        PluginAction::Allow { file, hash } => workbench.allow_plugin(file, hash),
        PluginAction::Switch { id, on } => workbench.switch_plugin(id, on),
        PluginAction::Check(file) => workbench.check_plugin(&file),
        PluginAction::Use(id) => workbench.use_plugin(&id),
    }
}
