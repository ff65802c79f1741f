//! What the plugin boundary costs: the same calls linked in, through the table of a loaded library, and of a library in a process of
//! its own, all guarded as in a run, beside the step of an encounter that they are part of.
//!
//! `cargo build --release && cargo bench -p endline-tests --bench boundary`; the loaded libraries are those that
//! `cargo xtask plugins --release` builds, in the folder named by `ENDLINE_PLUGINS`. Wanted: the boundary of a loaded library below 1 %
//! of a step.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a benchmark says what it needs"
)]

#[path = "../tests/linked/mod.rs"]
mod linked;

use std::env;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Instant;

use divan::Bencher;
use endline_friction_models::Coulomb;
use endline_gear::{Hooks, Options, Scenario, assemble};
use endline_sdk::{
    Contacts, Descriptor, FrictionModel, FrictionResponse, GearType, HookError, Region, WhaleMotion,
};
use endline_session::plugins::{Choices, Hook, Loader, PluginHost, PluginProblem, file_hash};
use endline_sim::{Input, Model, State, Workspace, step};
use linked::{Linked, library, report, root};

/// Contacts of a wrapped rope.
const CONTACTS: usize = 150;
const ATTRIBUTES: [f64; 2] = [1e7, 1.0];

/// Greatest number of steps until the rope has `WANTED` contacts with the whale, and the steps measured from there.
const UP_TO_CONTACT: usize = 1500;
const WANTED: usize = 4;
const MEASURED: usize = 100;

/// Calls of laws of friction, and contacts in them.
static CALLS: AtomicU64 = AtomicU64::new(0);
static CONTACTS_SEEN: AtomicU64 = AtomicU64::new(0);

fn main() {
    shares();
    divan::main();
}

/// Tells the calls of a step, the time of a step linked, loaded and in processes, and with that the boundary's share.
fn shares() {
    let (model, start) = at_contact(&Counted);
    CALLS.store(0, Ordering::Relaxed);
    CONTACTS_SEEN.store(0, Ordering::Relaxed);
    walk(&model, start);
    let per_step = |counter: &AtomicU64| counter.load(Ordering::Relaxed) as f64 / MEASURED as f64;
    println!(
        "a step of the encounter: {:.1} calls of friction, {:.0} contacts in them",
        per_step(&CALLS),
        per_step(&CONTACTS_SEEN)
    );
    let ways = [linked_host(), loaded_host(), out_of_process_host()].map(|host| at_contact(&host));
    let (mut fastest, mut waited, mut ends) = ([f64::INFINITY; 3], [f64::INFINITY; 3], [0; 3]);
    for _ in 0..12 {
        for (index, (model, state)) in ways.iter().enumerate() {
            let state = state.clone();
            let (begun, clock) = (seconds(), Instant::now());
            let end = walk(model, state);
            fastest[index] = fastest[index].min((seconds() - begun) / MEASURED as f64);
            waited[index] = waited[index].min(clock.elapsed().as_secs_f64() / MEASURED as f64);
            ends[index] = end.rope.position.iter().fold(0, |bits, at| bits ^ at.z.to_bits());
        }
    }
    assert!(ends.iter().all(|end| *end == ends[0]), "the same bits");
    for (way, of) in [("linked", 0), ("loaded", 1), ("in processes", 2)] {
        println!(
            "{way}: {:.1} us of this thread, {:.1} us by the clock a step, fastest of 12: {:+.2} %, {:+.2} %",
            1e6 * fastest[of],
            1e6 * waited[of],
            100.0 * (fastest[of] / fastest[0] - 1.0),
            100.0 * (waited[of] / waited[0] - 1.0)
        );
    }
}

/// The encounter of `hello-friction` with the whale set beside the rope, as the rope lies across it.
fn at_contact(hooks: &dyn Hooks) -> (Model, State) {
    let text = std::fs::read_to_string(root().join("scenarios/hello-friction.toml")).unwrap();
    let scenario = Scenario::read("hello-friction.toml", &text.replace("\"-22 m\"", "\"-9 m\""))
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let spec = assemble(&scenario, &library(), hooks, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let model = Model::new(spec).unwrap();
    let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
    for _ in 0..UP_TO_CONTACT {
        step(&model, &Input::default(), &mut state, &mut workspace).unwrap();
        if workspace.contacts.len() >= WANTED {
            return (model, state);
        }
    }
    panic!("the rope does not lie across the whale");
}

/// Time that this thread has been on a processor [s], where the system tells; a busy machine makes no difference to it.
fn seconds() -> f64 {
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds =
        statistics.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(
        || BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |nanoseconds| 1e-9 * nanoseconds,
    )
}

fn walk(model: &Model, mut state: State) -> State {
    let mut workspace = Workspace::new(model);
    for _ in 0..MEASURED {
        step(model, &Input::default(), &mut state, &mut workspace).unwrap();
    }
    state
}

fn linked_host() -> PluginHost {
    let mut host = PluginHost::empty();
    host.add(Hook::Motion(Arc::new(endline_whale_motions::Swim::new()))).unwrap();
    endline_friction_models::all()
        .into_iter()
        .map(Hook::Friction)
        .for_each(|hook| host.add(hook).unwrap());
    endline_gear_types::all().into_iter().map(Hook::Gear).for_each(|hook| host.add(hook).unwrap());
    host
}

fn folders() -> Vec<PathBuf> {
    env::var_os("ENDLINE_PLUGINS").iter().flat_map(env::split_paths).collect()
}

fn loaded_host() -> PluginHost {
    some(PluginHost::discover(&folders()))
}

/// The libraries of the folders in processes of their own.
fn out_of_process_host() -> PluginHost {
    let mut choices = Choices::kept_in(None, &[]);
    for folder in folders() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let file = entry.unwrap().path();
            choices.allow(&file, &file_hash(&file).unwrap()).unwrap();
        }
    }
    let mut loader =
        Loader::new(&folders(), choices).out_of_process(endline_tests::program().unwrap());
    let host = some(loader.load(&|_: &Path, _: &str| Ok(())));
    assert!(host.list().iter().all(|info| info.out_of_process), "in processes of their own");
    host
}

fn some((host, problems): (PluginHost, Vec<PluginProblem>)) -> PluginHost {
    assert!(
        problems.is_empty() && !host.ids().is_empty(),
        "name the folder of built plugins with ENDLINE_PLUGINS: {problems:?}"
    );
    host
}

/// The linked plugins, with every call of friction counted.
struct Counted;

struct Counting(Arc<dyn FrictionModel>);

impl FrictionModel for Counting {
    fn descriptor(&self) -> &Descriptor {
        self.0.descriptor()
    }
    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        CALLS.fetch_add(1, Ordering::Relaxed);
        CONTACTS_SEEN.fetch_add(contacts.len() as u64, Ordering::Relaxed);
        self.0.respond(attributes, contacts, out)
    }
    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        CALLS.fetch_add(1, Ordering::Relaxed);
        CONTACTS_SEEN.fetch_add(contacts.len() as u64, Ordering::Relaxed);
        self.0.advance(attributes, contacts, out)
    }
}

impl Hooks for Counted {
    fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        Linked.motion(id)
    }
    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        Linked.friction(id).map(|model| Arc::new(Counting(model)) as Arc<dyn FrictionModel>)
    }
    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        Linked.gear(id)
    }
    fn ids(&self) -> Vec<String> {
        Linked.ids()
    }
}

fn contacts() -> Contacts<'static> {
    Contacts {
        dt_s: 0.002,
        normal_force_n: &[20.0; CONTACTS],
        normal: &[[0.0, 0.0, 1.0]; CONTACTS],
        grain: &[[0.0, 1.0, 0.0]; CONTACTS],
        along: &[[1.0, 0.0, 0.0]; CONTACTS],
        slip_m: &[[1e-4, 2e-5, 0.0]; CONTACTS],
        length_m: &[0.025; CONTACTS],
        coefficient: &[0.2; CONTACTS],
        region: &[Region::Peduncle as u32; CONTACTS],
        rope: &[0; CONTACTS],
        state: &[1e-6; 3 * CONTACTS],
    }
}

fn respond(bencher: Bencher<'_, '_>, model: &dyn FrictionModel) {
    let mut out = [FrictionResponse::default(); CONTACTS];
    bencher.bench_local(|| {
        model.respond(&ATTRIBUTES, &divan::black_box(contacts()), &mut out).is_ok()
    });
}

/// The model called as a function of the program.
#[divan::bench]
fn friction_linked(bencher: Bencher<'_, '_>) {
    respond(bencher, &Coulomb::new());
}

/// The model linked in, watched over by the guard.
#[divan::bench]
fn friction_linked_and_guarded(bencher: Bencher<'_, '_>) {
    respond(bencher, linked_host().friction("org.endline.friction.coulomb").unwrap().as_ref());
}

/// The model through the table, watched over by the guard: what a run pays.
#[divan::bench]
fn friction_loaded_and_guarded(bencher: Bencher<'_, '_>) {
    respond(bencher, loaded_host().friction("org.endline.friction.coulomb").unwrap().as_ref());
}

/// The model in a process of its own, watched over by the guard.
#[divan::bench]
fn friction_out_of_process_and_guarded(bencher: Bencher<'_, '_>) {
    respond(
        bencher,
        out_of_process_host().friction("org.endline.friction.coulomb").unwrap().as_ref(),
    );
}
