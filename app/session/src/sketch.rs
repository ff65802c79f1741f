//! What a scenario or study contains, in few numbers, for a sketch of it: traps, endlines, a net, a whale, options.

use std::path::Path;

use endline_gear::Document;

/// Most options that are counted.
const MOST_OPTIONS: usize = 12;

/// Content of a sketch.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sketch {
    /// Number of traps.
    pub traps: usize,
    /// Number of endlines.
    pub endlines: usize,
    /// Whether there is a net.
    pub net: bool,
    /// Whether the endline is stowed at the trap.
    pub stowed: bool,
    /// Whether there is a whale.
    pub whale: bool,
    /// Number of options of a study.
    pub options: usize,
}

impl Sketch {
    /// Sketch of a scenario and its assembly.
    pub fn of_scenario(root: &Path, scenario: &Document) -> Self {
        let whale = scenario.has("whale");
        let id =
            ["gear.0.assembly", "field.0.assembly"].iter().find_map(|field| scenario.get(field));
        let assembly = id.and_then(|id| read(&root.join(format!("assemblies/{id}.toml"))));
        let gear = assembly.map(|assembly| Self::of_assembly(root, &assembly)).unwrap_or_default();
        Self { whale, ..gear }
    }

    fn of_assembly(root: &Path, assembly: &Document) -> Self {
        let number = |field: &str| assembly.get(field).and_then(|text| text.parse().ok());
        let gear_type = assembly.get("gear_type").unwrap_or_default();
        let kind = gear_type.rsplit('.').next().unwrap_or_default();
        let (traps, endlines) = match kind {
            "" => bodies(root, assembly),
            "pair" => (2, 1),
            "trawl" => (10, 2),
            "gillnet" => (2, 2),
            _ => (1, 1),
        };
        Self {
            traps: number("attributes.traps").unwrap_or(traps),
            endlines: number("attributes.endlines").unwrap_or(endlines),
            net: kind == "gillnet",
            stowed: kind == "on-demand",
            ..Self::default()
        }
    }

    /// Sketch of a study.
    pub fn of_study(study: &Document) -> Self {
        let options = (0..MOST_OPTIONS).take_while(|index| study.has(&format!("option.{index}")));
        Self { options: options.count().max(2), ..Self::default() }
    }

    /// Whether there is gear.
    pub fn has_gear(&self) -> bool {
        self.traps > 0 || self.endlines > 0
    }
}

/// Numbers of traps and endlines of an assembly that lists its parts: each buoy has an endline, each trap and each other body is
/// drawn as a trap.
fn bodies(root: &Path, assembly: &Document) -> (usize, usize) {
    let items = (0..).map_while(|index| assembly.get(&format!("body.{index}.item")));
    items.fold((0, 0), |(traps, buoys), item| {
        let is_buoy = root.join(format!("buoys/{item}.toml")).is_file();
        if is_buoy { (traps, buoys + 1) } else { (traps + 1, buoys) }
    })
}

fn read(path: &Path) -> Option<Document> {
    Document::parse(&endline_gear::read::text(path).ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sketch_shows_the_content_of_its_files() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        let of = |id: &str| {
            let scenario = read(&root.join(format!("scenarios/{id}.toml"))).unwrap();
            Sketch::of_scenario(&root, &scenario)
        };
        let single = of("hello-endline");
        assert_eq!((single.traps, single.endlines, single.whale), (1, 1, true));
        assert_eq!(of("trawl-45").traps, 45);
        assert!(of("gillnet").net);
        assert!(of("on-demand-release").stowed);
        assert!(!of("portrait").has_gear());
    }
}
