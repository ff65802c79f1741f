//! Small made-up crates of known shape.

use super::circles::circles;
use super::code::code;
use super::functions::{Function, functions};
use super::tree::{Crate, crates, members};

/// A crate in the folder `c` of these files below `c/src`.
fn made_up(files: &[(&str, &str)]) -> Crate {
    let read = |path: &str| {
        let found = files.iter().find(|(name, _)| path == format!("c/src/{name}"));
        found.map(|(_, text)| (*text).to_owned())
    };
    crates(&["c".to_owned()], &read).pop().expect("a root")
}

/// The files of each circle.
fn circles_of(files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let short = |file: String| file.trim_start_matches("c/src/").to_owned();
    let all = circles(&made_up(files)).into_iter();
    all.map(|circle| circle.files.into_iter().map(short).collect()).collect()
}

fn functions_of(text: &str) -> Vec<Function> {
    functions(&code(text).expect("not of tests alone").tokens)
}

#[test]
fn files_that_name_each_other_are_a_circle() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b; mod c;"),
        ("a.rs", "use crate::b::B; pub struct A(B);"),
        ("b.rs", "pub struct B; impl B { fn f(self) { super::a::A(self); } }"),
        ("c.rs", "use crate::{a::A, b::{self, B}}; fn f(x: A, y: B, z: b::B) {}"),
    ]);
    assert_eq!(found, [["a.rs", "b.rs"]]);
}

#[test]
fn a_circle_through_three_files_in_folders_is_found() {
    let found = circles_of(&[
        ("main.rs", "mod a; mod b;"),
        ("a/mod.rs", "pub mod one; mod two; pub use two::Two;"),
        ("a/one.rs", "use crate::b; fn f() { b::call() }"),
        ("a/two.rs", "use super::one::*; pub struct Two;"),
        ("b.rs", "pub fn call() -> crate::a::Two { loop {} }"),
    ]);
    assert_eq!(found, [["a/one.rs", "a/two.rs", "b.rs"]], "through a re-export and a glob");
}

#[test]
fn parent_and_child_and_what_tests_name_are_no_circle() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b; pub struct Root;"),
        ("a/mod.rs", "mod deep; use deep::Deep; pub struct A(Deep);"),
        ("a/deep.rs", "use super::A; use crate::Root; pub struct Deep(Box<A>, Root);"),
        (
            "b.rs",
            "//! See crate::a::A.\n use crate::a::A; /* crate::a */ pub struct B; \
             const TEXT: &str = \"crate::c::C\";",
        ),
        ("c.rs", "not reached by any root"),
    ]);
    assert_eq!(found, Vec::<Vec<String>>::new());
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "pub struct A; #[cfg(test)] mod tests { use crate::b::B; }"),
        ("b.rs", "use crate::a::A; pub struct B;"),
    ]);
    assert_eq!(found, Vec::<Vec<String>>::new(), "tests may name everything");
}

#[test]
fn a_module_written_out_counts_as_its_file() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "pub mod inner { use super::super::b::B; pub struct A; }"),
        ("b.rs", "use crate::a::inner::A as Other; pub struct B(Other);"),
    ]);
    assert_eq!(found, [["a.rs", "b.rs"]]);
}

#[test]
fn an_item_of_another_crate_is_no_edge() {
    let found = circles_of(&[
        ("lib.rs", "mod fmt; mod b;"),
        ("fmt.rs", "use crate::b::B; pub struct Formatter;"),
        ("b.rs", "use std::fmt; pub struct B; fn f(_: &mut fmt::Formatter) {}"),
    ]);
    assert_eq!(found, Vec::<Vec<String>>::new());
}

#[test]
fn functions_are_measured_from_fn_to_brace() {
    let text = "/// Doc.\n#[inline]\npub fn one<F: Fn(u8, u8) -> u8>(f: F) -> [u8; 2] {\n    // comment\n\
                \n    let text = \"} fn no() {\n\";\n    [f(1, 2); 2]\n}\ntrait T { fn none(&self); }";
    let found = functions_of(text);
    assert_eq!(found.len(), 1, "one without a body is not counted");
    let one = &found[0];
    assert_eq!((one.name.as_str(), one.line, one.lines, one.body_lines), ("one", 3, 7, 3));
}

#[test]
fn members_of_anonymous_tuples_are_arguments() {
    let count = |arguments: &str| functions_of(&format!("fn f({arguments}) {{}}"))[0].arguments;
    assert_eq!(count(""), 0);
    assert_eq!(count("&mut self, a: u8,"), 1);
    assert_eq!(count("self: Box<Self>, a: u8"), 1);
    assert_eq!(count("(a, b): (u8, &str), c: &'a (u8, (f64, f64))"), 5);
    assert_eq!(count("f: impl Fn(u8, u8) -> (u8, u8), g: &[(u8, u8)], h: Map<u8, (u8, u8)>"), 3);
    assert_eq!(count("nothing: ()"), 1);
    assert_eq!(functions_of("extern \"C\" fn f(a: u8, b: u8) {}")[0].arguments, 0);
}

#[test]
fn lines_of_tests_are_not_lines_of_the_file() {
    let text =
        "fn a() {}\n#[cfg(test)]\nmod tests {\n    fn b() {}\n}\n#[cfg(not(test))]\nfn c() {}\n";
    let code = code(text).unwrap();
    assert_eq!(code.lines, 3);
    let names: Vec<String> = functions(&code.tokens).into_iter().map(|one| one.name).collect();
    assert_eq!(names, ["a", "c"]);
    assert!(super::code::code("#![cfg(test)]\nfn a() {}").is_none());
}

#[test]
fn literals_hide_what_stands_in_them() {
    let text = "fn a<'a>(x: &'a u8) -> char { '{' }\nfn b() -> char { '\\'' }\n\
                fn c() { r#\"} \" fn no() {\"#; b\"{\"; 1.0e-3; 'é'; '\\u{7b}'; r#type; 1..2 }\n\
                /* fn no() {} /* nested */ } */ fn d() {}";
    let names: Vec<String> = functions_of(text).into_iter().map(|one| one.name).collect();
    assert_eq!(names, ["a", "b", "c", "d"]);
}

#[test]
fn members_are_read_from_the_manifest() {
    let manifest =
        "[workspace]\nmembers = [\n    \"app/one\",\n    \"two\",\n]\n[other]\nx = [\"no\"]";
    assert_eq!(members(manifest), ["app/one", "two"]);
}
