//! The plugin host as the gear library sees it.

use std::sync::Arc;

use endline_gear::Hooks;
use endline_sdk::{FrictionModel, GearType, WhaleMotion};

use crate::plugins::PluginHost;

impl Hooks for PluginHost {
    fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        self.motion(id)
    }

    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        self.friction(id)
    }

    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        self.gear(id)
    }

    fn ids(&self) -> Vec<String> {
        self.ids()
    }
}
