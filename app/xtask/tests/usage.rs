//! Wrong use says what is right, and gives the exit code of wrong use.

use std::process::Command;

#[test]
fn wrong_use_prints_the_chores_and_gives_2() {
    for words in [
        vec![],
        vec!["tset"],
        vec!["run", "--release"],
        vec!["plugins", "debug"],
        vec!["golden", "soak"],
    ] {
        let answer = Command::new(env!("CARGO_BIN_EXE_xtask")).args(&words).output().unwrap();
        let said = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(2), "{words:?}");
        assert!(
            ["cargo xtask run", "cargo xtask test", "cargo xtask plugins"]
                .iter()
                .all(|chore| said.contains(chore)),
            "{said}"
        );
    }
}
