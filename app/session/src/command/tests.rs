use std::collections::BTreeSet;

use super::*;

#[test]
fn every_command_is_declared_once_under_a_name_of_its_own() {
    let [mut ids, mut names] = [BTreeSet::new(), BTreeSet::new()];
    for info in declared() {
        assert!(ids.insert(info.id), "{} is declared twice", info.id);
        assert!(names.insert(info.name), "two commands are called {}", info.name);
        assert!(info.help.ends_with('.'), "{}: {}", info.id, info.help);
        if let Make::Plain(command) = &info.make {
            assert_eq!(command.id(), info.id, "the command made is the one declared");
        }
    }
}
