//! The right whale of the library equals the built-in one.

use std::path::Path;

use endline_gear::whale::{WhaleForm, build_skin};
use endline_gear::{Library, Sources};

#[test]
fn the_file_and_the_built_in_form_give_the_same_skin() {
    let sources = Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let (library, _) = Library::read(&sources);
    let whale = library.whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap();
    let from_file = build_skin(&whale.form);
    let built_in = build_skin(&WhaleForm::right_whale(whale.form.length_m));
    assert_eq!(from_file.triangles, built_in.triangles);
    for (filed, built) in from_file.vertices.iter().zip(&built_in.vertices) {
        assert!(filed.distance(*built) < 0.001, "{filed} in the file, {built} built in");
    }
}
