use std::collections::BTreeSet;

use super::*;

#[test]
fn every_command_is_declared_once_under_a_name_of_its_own() {
    let [mut ids, mut names] = [BTreeSet::new(), BTreeSet::new()];
    for info in declared() {
        assert!(ids.insert(info.about.id), "{} is declared twice", info.about.id);
        assert!(names.insert(info.about.name), "two commands are called {}", info.about.name);
        assert!(info.about.help.ends_with('.'), "{}: {}", info.about.id, info.about.help);
        if let Make::Plain(command) = &info.make {
            assert_eq!(command.id(), info.about.id, "the command made is the one declared");
        }
    }
}
