//! Small models and sources for tests of this crate.

use std::sync::Arc;

use endline_gear::Sources;
use endline_sim::model::{Joint, JointKind, Line, Rope, Settings, Strength};
use endline_sim::water::{Current, Water};
use endline_sim::{DVec3, Model, ModelSpec};

use super::{Overrides, Prepared, Source};

/// A source with one file, for tests of the file format.
pub(crate) fn source() -> Source {
    let mut library = Sources::default();
    library.set("ropes/sample.toml", "name = \"sample\"");
    Source {
        scenario_name: "sample.toml".into(),
        scenario: "duration = \"1 s\"".into(),
        library,
        overrides: Overrides::default(),
    }
}

/// Ten metres of rope hung from a fixed point in still water.
pub(crate) fn hanging_rope(duration_s: f64) -> Prepared {
    let joint =
        |id: &str, kind, z| Joint { id: id.into(), kind, position_m: DVec3::new(0.0, 0.0, z) };
    let spec = ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_m: 40.0,
            current: Current::uniform(DVec3::ZERO),
            rope_dries: true,
            waves: None,
        },
        seabed: None,
        ropes: vec![rope()],
        joints: vec![joint("top", JointKind::Fixed, -1.0), joint("tail", JointKind::Free, -11.0)],
        lines: vec![Line {
            id: "line".into(),
            rope: 0,
            from: 0,
            to: 1,
            segments_m: vec![1.0; 10],
            strength: Strength::default(),
            weak_places: Vec::new(),
            knots_m: [0.0; 2],
            start_m: vec![],
        }],
        bodies: vec![],
        links: vec![],
        gear: vec![],
        whale: None,
        friction: None,
        obstacles: vec![],
        probes: vec![],
        settings: Settings { duration_s, ..Settings::default() },
    };
    Prepared {
        source: Arc::new(source()),
        model: Arc::new(Model::new(spec).unwrap()),
        plugins: vec![],
        strengths: [].into(),
    }
}

fn rope() -> Rope {
    Rope {
        id: "rope".into(),
        diameter_m: 0.01,
        mass_kg_m: 0.06,
        displaced_m3_m: 5e-5,
        axial_stiffness_n: 2e4,
        axial_damping_n_s: 10.0,
        drag_normal: 1.2,
        drag_tangential: 0.01,
        added_mass_normal: 1.0,
        ..Rope::default()
    }
}
