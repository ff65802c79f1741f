//! The targets and their inputs: the shipped files of each kind, and the corpus of inputs that failed before.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use endline_gear::whale::gltf::{About, Form, read, write};
use endline_gear::{
    Case, Document, Library, Observation, Options, Scenario, Study, Table, TextPlugin, WhaleItem,
    assemble,
};
use endline_sdk::Controls;
use endline_session::Recording;
use endline_session::hash::StateHash;
use endline_session::recording::Header;
use endline_session::rules::Packs;
use endline_sim::{Input, Model, State, Workspace, settle, step};

use crate::linked::{Linked, library, root};
use crate::mutate::{Dice, other_number};

/// Most rope nodes of a scenario that is settled and stepped: the physics is the same, and quick.
const NODES: u64 = 60;
/// Steps that it takes.
const STEPS: usize = 10;

/// How a file is damaged.
pub type Damage = fn(&[u8], &mut Dice) -> Vec<u8>;

/// A reader, or more than one in a row.
pub struct Target {
    pub name: &'static str,
    /// Sound files to damage.
    pub seeds: Vec<Vec<u8>>,
    /// Inputs that once did harm.
    pub known: Vec<Vec<u8>>,
    /// How to damage them; anyhow where none is given.
    pub damage: Option<Damage>,
    /// Feeds an input; whether it was read, or what went wrong.
    pub feed: fn(&[u8]) -> Result<bool, String>,
}

/// Every target.
pub fn all() -> Vec<Target> {
    vec![
        target(
            "item",
            files(&["ropes", "traps", "buoys", "whales", "weak-links", "sites", "knots"]),
            item,
        ),
        target("act", files(&["acts"]), act),
        target("assembly", files(&["assemblies"]), assembly),
        target("scenario", files(&["scenarios"]), scenario),
        target("study", files(&["studies"]), |bytes| {
            Ok(Study::read("s.toml", &text(bytes)).is_ok())
        }),
        target("case", files(&["cases"]), |bytes| Ok(Case::read("c.toml", &text(bytes)).is_ok())),
        target("observation", files(&["observations"]), |bytes| {
            Ok(Observation::read("o.toml", &text(bytes)).is_ok())
        }),
        target("rules", files(&["rules"]), rules),
        target("document", files(&["scenarios", "ropes"]), document),
        target("table", files(&["cases/tables"]), |bytes| {
            Ok(Table::read("t.csv", &text(bytes)).is_ok())
        }),
        target("plugin", plugins(), plugin),
        target("gltf", meshes(), mesh),
        target("recording", vec![recording()], recording_of),
        Target {
            damage: Some(|bytes, dice| {
                let mut bytes = bytes.to_vec();
                (0..=dice.below(3)).for_each(|_| other_number(&mut bytes, dice));
                bytes
            }),
            ..target("stepped", files(&["scenarios"]), stepped)
        },
    ]
}

fn target(
    name: &'static str,
    seeds: Vec<Vec<u8>>,
    feed: fn(&[u8]) -> Result<bool, String>,
) -> Target {
    assert!(!seeds.is_empty(), "`{name}` has nothing to begin with");
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name);
    Target { name, seeds, known: in_folder(&corpus), damage: None, feed }
}

/// Contents of the shipped files of these folders.
fn files(folders: &[&str]) -> Vec<Vec<u8>> {
    folders.iter().flat_map(|folder| in_folder(&root().join(folder))).collect()
}

fn in_folder(folder: &Path) -> Vec<Vec<u8>> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> =
        entries.map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    paths.sort();
    paths.into_iter().map(|path| std::fs::read(path).unwrap()).collect()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn item(bytes: &[u8]) -> Result<bool, String> {
    let text = text(bytes);
    let folders = ["ropes", "traps", "buoys", "whales", "weak-links", "sites", "knots"];
    let found = folders.map(|folder| Library::check_file(&format!("{folder}/x.toml"), &text));
    Ok(found.iter().any(|problems| problems.iter().all(|problem| !problem.is_error())))
}

fn act(bytes: &[u8]) -> Result<bool, String> {
    Ok(Library::check_file("acts/x.toml", &text(bytes)).is_empty())
}

fn assembly(bytes: &[u8]) -> Result<bool, String> {
    Ok(Library::check_file("assemblies/x.toml", &text(bytes)).is_empty())
}

fn shipped() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(library)
}

fn scenario(bytes: &[u8]) -> Result<bool, String> {
    let Ok(scenario) = Scenario::read("s.toml", &text(bytes)) else { return Ok(false) };
    let spec = assemble(&scenario, shipped(), &Linked, &Options::default());
    Ok(spec.is_ok_and(|spec| Model::new(spec).is_ok()))
}

/// Valid by its schema, then settled, where it is not taken as placed, and a few steps: its numbers stay numbers.
fn stepped(bytes: &[u8]) -> Result<bool, String> {
    let Ok(scenario) = Scenario::read("s.toml", &text(bytes)) else { return Ok(false) };
    let options = Options { rope_nodes: Some(NODES), ..Options::default() };
    let Ok(spec) = assemble(&scenario, shipped(), &Linked, &options) else { return Ok(false) };
    let Ok(model) = Model::new(spec) else { return Ok(false) };
    let placed = model.spec.settings.as_placed;
    let mut state = if placed { State::start(&model) } else { settle(&model).state };
    let mut workspace = Workspace::new(&model);
    for _ in 0..STEPS {
        if step(&model, &Input::default(), &mut state, &mut workspace).is_err() {
            break;
        }
    }
    let finite = state.rope.position.iter().all(|place| place.is_finite())
        && state.bodies.iter().all(|body| body.position.is_finite());
    if finite { Ok(true) } else { Err("a place is not finite".into()) }
}

fn rules(bytes: &[u8]) -> Result<bool, String> {
    let file = scratch("rules.toml", bytes);
    Ok(Packs::check(&file, Some(&root())).is_ok())
}

fn document(bytes: &[u8]) -> Result<bool, String> {
    let text = text(bytes);
    let Ok(document) = Document::parse(&text) else { return Ok(false) };
    // What is written of a document that was read can be read again.
    Document::parse(&document.text()).map(|_| true).map_err(|error| error.to_string())
}

/// A plugin without code: its manifest and its gear type, one after the other.
fn plugins() -> Vec<Vec<u8>> {
    let templates = root().join("../app/session/src/plugins/new/templates");
    let [head, gear] = ["plugin.toml", "gear.toml"].map(|name| {
        let text = std::fs::read_to_string(templates.join(name)).unwrap();
        text.replace("@id@", "org.example.gear.row").replace("@title@", "A row")
    });
    vec![format!("{head}{PARTED}{gear}").into_bytes()]
}

/// What parts the two.
const PARTED: &str = "#---\n";

fn plugin(bytes: &[u8]) -> Result<bool, String> {
    let text = text(bytes);
    let (head, gear) = text.split_once(PARTED).unwrap_or((&text, ""));
    let folder = scratch("plugin/plugin.toml", head.as_bytes());
    scratch("plugin/gear-types/one.toml", gear.as_bytes());
    let Ok(plugin) = TextPlugin::from_folder(folder.parent().unwrap()) else { return Ok(false) };
    let site = endline_sdk::Site { depth_m: 30.0, current_m_s: [0.0; 2] };
    for gear in &plugin.gear {
        let values: Vec<_> = gear
            .descriptor()
            .attributes
            .iter()
            .map(endline_sdk::Attribute::default_value)
            .collect();
        // A gear type may refuse values with a reason.
        let _ = gear.build(&values, &site);
    }
    Ok(true)
}

fn whale() -> &'static WhaleItem {
    shipped().whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap()
}

fn skin() -> &'static endline_sim::whale::Skin {
    static SKIN: OnceLock<endline_sim::whale::Skin> = OnceLock::new();
    SKIN.get_or_init(|| whale().skin_at(13.7))
}

fn meshes() -> Vec<Vec<u8>> {
    let joints = &whale().joints.ranges;
    let about = About { id: "right-whale", name: "Right whale", length_m: 13.7, joints };
    vec![write(skin(), &about, Form::Binary), write(skin(), &about, Form::Text)]
}

fn mesh(bytes: &[u8]) -> Result<bool, String> {
    Ok(read(bytes, skin()).is_ok())
}

/// A recording of a moment.
fn recording() -> Vec<u8> {
    let file = scratch("made.endline", b"");
    let source = endline_session::Source {
        scenario_name: "s.toml".into(),
        scenario: "format = 1\n".into(),
        ..endline_session::Source::default()
    };
    let recording = Recording {
        header: Header::default(),
        source,
        inputs: vec![Controls::default(); 3],
        hashes: vec![StateHash::default(); 4],
        damage: None,
    };
    recording.save(&file).unwrap();
    std::fs::read(file).unwrap()
}

fn recording_of(bytes: &[u8]) -> Result<bool, String> {
    Ok(Recording::load(&scratch("read.endline", bytes)).is_ok())
}

/// A file of this thread's own, with this content.
fn scratch(name: &str, bytes: &[u8]) -> PathBuf {
    let thread = format!("{:?}", std::thread::current().id());
    let number: String = thread.chars().filter(char::is_ascii_digit).collect();
    let folder = std::env::temp_dir().join(format!("endline-fuzz-{}-{number}", std::process::id()));
    let file = folder.join(name);
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    std::fs::write(&file, bytes).unwrap();
    file
}
