//! What the plugin boundary costs: the same calls linked in, through the table of a loaded library, and guarded as in a run,
//! beside the step that they are part of.
//!
//! `cargo bench -p endline-tests --bench boundary`; the loaded library is the one that `cargo xtask plugins` builds, named by
//! `ENDLINE_PLUGINS`.

use std::env;
use std::path::PathBuf;
use std::sync::Arc;

use divan::Bencher;
use endline_friction_models::Coulomb;
use endline_sdk::{Contacts, FrictionModel, FrictionResponse, Region};
use endline_session::plugins::PluginHost;

fn main() {
    divan::main();
}

/// Contacts of a wrapped rope.
const CONTACTS: usize = 150;
const ATTRIBUTES: [f64; 2] = [1e7, 1.0];

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
    bencher.bench_local(|| model.respond(&ATTRIBUTES, &divan::black_box(contacts()), &mut out).is_ok());
}

/// The model called as a function of the program.
#[divan::bench]
fn friction_linked(bencher: Bencher<'_, '_>) {
    respond(bencher, &Coulomb::new());
}

/// The model through the table, watched over by the guard: what a run pays.
#[divan::bench]
fn friction_loaded_and_guarded(bencher: Bencher<'_, '_>) {
    let folders: Vec<PathBuf> = env::var_os("ENDLINE_PLUGINS").iter().flat_map(env::split_paths).collect();
    let (host, _) = PluginHost::discover(&folders);
    let model: Option<Arc<dyn FrictionModel>> = host.friction("org.endline.friction.coulomb");
    match model {
        Some(model) => respond(bencher, model.as_ref()),
        None => bencher.bench_local(|| ()),
    }
}

/// The model linked in, watched over by the guard.
#[divan::bench]
fn friction_linked_and_guarded(bencher: Bencher<'_, '_>) {
    let mut host = PluginHost::empty();
    let added = host.add(endline_session::plugins::Hook::Friction(Arc::new(Coulomb::new())));
    if let (Ok(()), Some(model)) = (added, host.friction("org.endline.friction.coulomb")) {
        respond(bencher, model.as_ref());
    }
}
