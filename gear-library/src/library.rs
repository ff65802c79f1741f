//! The library: every item of every kind, read and checked.

use crate::assembly::Assembly;
use crate::diagnostic::{Diagnostic, hint};
use crate::entry::{self, Entry};
use crate::fields::Problems;
use crate::items::{
    ActItem, BoxGear, Buoy, Knot, Rope, RopeFriction, SeaSite, WeakLink, WhaleItem,
};
use crate::schema::Kind;
use crate::sources::Sources;
use crate::tree;

/// Items by kind, each kind by id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    /// Ropes.
    pub ropes: Vec<Rope>,
    /// Traps.
    pub traps: Vec<BoxGear>,
    /// Buoys.
    pub buoys: Vec<Buoy>,
    /// Weak links.
    pub weak_links: Vec<WeakLink>,
    /// Knots and splices.
    pub knots: Vec<Knot>,
    /// Anchors.
    pub anchors: Vec<BoxGear>,
    /// Sites.
    pub sites: Vec<SeaSite>,
    /// Friction by rope material.
    pub frictions: Vec<RopeFriction>,
    /// Whales.
    pub whales: Vec<WhaleItem>,
    /// Acts of whales.
    pub acts: Vec<ActItem>,
    /// Assemblies.
    pub assemblies: Vec<Assembly>,
}

impl Library {
    /// Reads all files; files with errors are omitted, and all problems are returned.
    pub fn read(sources: &Sources) -> (Self, Vec<Diagnostic>) {
        let mut library = Self::default();
        let all = Problems::default();
        for (path, text) in sources.iter() {
            let problems = Problems::default();
            library.read_file(path, text, &problems);
            all.extend(problems.into_sorted());
        }
        library.read_meshes(sources, &all);
        library.check_materials(&all);
        (library, all.into_sorted())
    }

    /// Problems of one file; its mesh or animation is not read.
    pub fn check_file(path: &str, text: &str) -> Vec<Diagnostic> {
        let problems = Problems::default();
        Self::default().read_file(path, text, &problems);
        problems.into_sorted()
    }

    /// Problems of one file and of its mesh or animation in `meshes`.
    pub fn check_file_with(path: &str, text: &str, meshes: &Sources) -> Vec<Diagnostic> {
        let problems = Problems::default();
        let mut library = Self::default();
        library.read_file(path, text, &problems);
        library.read_meshes(meshes, &problems);
        problems.into_sorted()
    }

    /// Reads the meshes of whales and the animations of acts; items with invalid ones are omitted.
    fn read_meshes(&mut self, meshes: &Sources, problems: &Problems) {
        self.whales.retain_mut(|whale| whale.load_mesh(meshes, problems));
        self.acts.retain_mut(|act| act.load_animation(meshes, problems));
    }

    fn read_file(&mut self, path: &str, text: &str, problems: &Problems) {
        let (folder, file) = path.rsplit_once('/').unwrap_or(("", path));
        let folder = folder.rsplit('/').next().unwrap_or_default();
        let id = file.trim_end_matches(".toml");
        let Some(kind) = Kind::in_folder(folder) else {
            let folders = Kind::ALL.iter().map(|kind| kind.folder());
            problems.push(Diagnostic::of_file(
                path,
                format!("`{folder}` is not a folder of a library"),
                hint(folder, folders),
            ));
            return;
        };
        let node = match tree::read(path, text) {
            Ok(node) => node,
            Err(problem) => return problems.push(*problem),
        };
        self.read_item(&node, kind, id, problems);
    }

    /// Adds an item if its file has no error.
    fn read_item(&mut self, node: &tree::Node, kind: Kind, id: &str, problems: &Problems) {
        fn add<T>(items: &mut Vec<T>, item: Option<T>, problems: &Problems) {
            items.extend(item.filter(|_| !problems.any_error()));
        }
        let entry = || entry::read(node, kind, id, problems);
        match kind {
            Kind::Rope => add(&mut self.ropes, Rope::from_entry(entry(), problems), problems),
            Kind::Trap => add(&mut self.traps, BoxGear::from_entry(entry(), problems), problems),
            Kind::Anchor => {
                add(&mut self.anchors, BoxGear::from_entry(entry(), problems), problems)
            }
            Kind::Buoy => add(&mut self.buoys, Buoy::from_entry(entry(), problems), problems),
            Kind::WeakLink => add(&mut self.weak_links, WeakLink::from_entry(entry()), problems),
            Kind::Knot => add(&mut self.knots, Knot::from_entry(entry()), problems),
            Kind::Site => add(&mut self.sites, SeaSite::from_entry(entry(), problems), problems),
            Kind::Friction => {
                add(&mut self.frictions, RopeFriction::read(node, id, problems), problems)
            }
            Kind::Whale => add(&mut self.whales, WhaleItem::read(node, id, problems), problems),
            Kind::Act => add(&mut self.acts, ActItem::read(node, id, problems), problems),
            Kind::Assembly => {
                add(&mut self.assemblies, Assembly::read(node, id, problems), problems)
            }
        }
    }

    /// Checks that the materials of ropes are items of `friction/`.
    fn check_materials(&self, problems: &Problems) {
        let known = self.ids(Kind::Friction);
        for rope in self.ropes.iter().filter(|rope| !known.contains(&rope.material.as_str())) {
            if let Some(word) = rope.entry.word("material") {
                problems.push(word.place.error(
                    format!("no `{}` in friction/", rope.material),
                    hint(&rope.material, known.iter().copied()),
                ));
            }
        }
    }

    /// The files of a kind, by id.
    pub fn entries(&self, kind: Kind) -> Vec<&Entry> {
        match kind {
            Kind::Rope => self.ropes.iter().map(|item| &item.entry).collect(),
            Kind::Trap => self.traps.iter().map(|item| &item.entry).collect(),
            Kind::Buoy => self.buoys.iter().map(|item| &item.entry).collect(),
            Kind::WeakLink => self.weak_links.iter().map(|item| &item.entry).collect(),
            Kind::Knot => self.knots.iter().map(|item| &item.entry).collect(),
            Kind::Anchor => self.anchors.iter().map(|item| &item.entry).collect(),
            Kind::Site => self.sites.iter().map(|item| &item.entry).collect(),
            Kind::Friction => self.frictions.iter().map(|item| &item.entry).collect(),
            Kind::Whale => self.whales.iter().map(|item| &item.entry).collect(),
            Kind::Act => self.acts.iter().map(|item| &item.entry).collect(),
            Kind::Assembly => self.assemblies.iter().map(|item| &item.entry).collect(),
        }
    }

    /// The ids of a kind.
    pub fn ids(&self, kind: Kind) -> Vec<&str> {
        self.entries(kind).into_iter().map(|entry| entry.id.as_str()).collect()
    }

    /// A file by kind and id.
    pub fn entry(&self, kind: Kind, id: &str) -> Option<&Entry> {
        self.entries(kind).into_iter().find(|entry| entry.id == id)
    }
}
