//! Files of acts: the shipped files are valid and play, and a mistake is reported with its place.

use endline_gear::{Library, Options, Scenario, Sources, assemble, assemble_traced};

use crate::linked::{Linked, library, report, root};

#[test]
fn what_observers_list_is_shipped_and_every_act_has_an_id_of_its_own() {
    let library = library();
    let ids: Vec<&str> =
        library.acts.iter().flat_map(|act| act.clips.iter().map(|clip| clip.id.as_str())).collect();
    for wanted in [
        "glide descent ascent level fluking-dive barrel-roll skim-feed skim-feed-on-right-side close-mouth",
        "flippers-abduct flippers-adduct flippers-pronate flippers-supinate flippers-sweep flippers-tuck",
        "belly-up side-lying-on-right flipper-slap-left flipper-slap-right flipper-stroke-left head-lift head-push tail-slap",
        "tail-lift peduncle-throw-left breach nuzzle body-slide-left logging posturing",
        "flinch turn-away roll-away roll-toward thrash-flipper thrash-tail bolt dive-away",
        "barrel-roll-away barrel-roll-toward veer-from-left veer-from-right halt sink",
    ] {
        wanted.split(' ').for_each(|id| assert!(ids.contains(&id), "{id} is not shipped"));
    }
    let mut sorted = ids.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(sorted.len(), ids.len());
    assert!(library.acts.iter().all(|act| !act.entry.notes.is_empty()), "each says what it does");
}

/// `docs/motions.md` names every act and every channel of a key.
#[test]
fn the_manual_names_every_act_and_every_channel() {
    let manual = std::fs::read_to_string(root().join("../docs/motions.md")).unwrap();
    let library = library();
    let acts = library.acts.iter().flat_map(|act| act.clips.iter().map(|clip| clip.id.as_str()));
    for name in acts.chain(endline_gear::CHANNELS.iter().map(|channel| channel.key)) {
        assert!(manual.contains(&format!("`{name}`")), "docs/motions.md lacks `{name}`");
    }
}

const FLINCH: &str = "acts/flinch.toml";

/// Returns the diagnostics of the flinch with a change in it.
fn problems_of(from: &str, to: &str) -> String {
    let text = Sources::from_folder(&root()).unwrap().get(FLINCH).unwrap().to_owned();
    assert!(text.contains(from), "{from}");
    let text = text.replacen(from, to, 1);
    let problems = Library::check_file(FLINCH, &text);
    assert!(!problems.is_empty(), "this reads: {to}");
    assert!(problems.iter().all(|problem| problem.file == FLINCH && problem.line > 0));
    report(&problems)
}

#[test]
fn a_mistake_in_an_act_is_reported_with_its_place_and_correction() {
    for (from, to, parts) in [
        (
            "spine_yaw = \"40 deg\"",
            "spin_yaw = \"40 deg\"",
            ["unknown field `spin_yaw`", "did you mean `spine_yaw`?"],
        ),
        (
            "at = \"3 s\"",
            "at = \"0.5 s\"",
            ["keys are not in rising order of `at`", "order of time"],
        ),
        (
            "spine_yaw = \"40 deg\"",
            "spine_yaw = \"140 deg\"",
            ["`spine_yaw` is 2.44", "it must be between -1.8"],
        ),
        (
            "flipper_raise = [\"-30 deg\", \"0 deg\"]",
            "flipper_raise = [\"-90 deg\", \"0 deg\"]",
            ["`flipper_raise` is -1.57", "between -1.39"],
        ),
        (
            "flipper_raise = [\"-30 deg\", \"0 deg\"]",
            "flipper_raise = [\"-30 deg\"]",
            ["`flipper_raise` has 1 values", "left, right"],
        ),
        ("spine_yaw = \"40 deg\"", "spine_yaw = 40", ["without a unit", "deg"]),
        ("at = \"0.8 s\"", "", ["`at` is missing", "time since the start of the act"]),
        (
            "blend = \"add\"",
            "blend = \"ad\"",
            ["`ad` is not a value of `blend`", "did you mean `add`?"],
        ),
        (
            "side = \"touched\"",
            "after = \"repeat\"\nside = \"touched\"\nends_at_touch = [\"hed\"]",
            ["`hed` is not a part", "did you mean `head`?"],
        ),
        ("fade = \"0.6 s\"", "", ["`fade` is missing", "expected a time"]),
        ("source = ", "notes2 = ", ["has no source", "source ="]),
    ] {
        let message = problems_of(from, to);
        assert!(parts.iter().all(|part| message.contains(part)), "{to}: {message}");
    }
}

#[test]
fn an_act_that_repeats_must_close() {
    let closed = "format = 1\nkind = \"act\"\nname = \"Wave\"\nsource = \"test\"\nconfidence = \"estimate\"\nfade = \"1 s\"\nafter = \"repeat\"\n\
                  [[key]]\nat = \"0 s\"\njaw = \"0 deg\"\nroll = \"0 deg\"\n[[key]]\nat = \"2 s\"\njaw = \"9 deg\"\n[[key]]\nat = \"4 s\"\njaw = \"0 deg\"\nroll = \"1 turn\"\n";
    let problems = |text: &str| report(&Library::check_file("acts/wave.toml", text));
    assert_eq!(problems(closed), "", "a turn may continue to grow");
    let open = closed.replace("at = \"4 s\"\njaw = \"0 deg\"", "at = \"4 s\"\njaw = \"3 deg\"");
    assert!(
        problems(&open).contains("`jaw` has different values at the start and the end"),
        "{}",
        problems(&open)
    );
    let short = closed.replace("at = \"4 s\"\njaw = \"0 deg\"", "at = \"4 s\"");
    assert!(
        problems(&short).contains("`jaw` does not cover a repeated act from start to end"),
        "{}",
        problems(&short)
    );
}

fn scenario(acts: &str) -> String {
    let text = std::fs::read_to_string(root().join("scenarios/hello-endline.toml")).unwrap();
    text.replacen("[whale.attributes]", &format!("{acts}\n\n[whale.attributes]"), 1)
}

/// A scientist's own act, in a library folder of their own, named in a scenario: it is the whale's, with its file in the recording.
#[test]
fn an_act_is_added_with_a_file_alone() {
    let mut sources = Sources::from_folder(&root()).unwrap();
    let mine = sources
        .get("acts/roll-away.toml")
        .unwrap()
        .replace("150 deg", "90 deg")
        .replace("Roll away", "Mine");
    sources.set("acts/mine.toml", mine);
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", report(&problems));
    let text = scenario(
        "acts = [\"mine\", \"barrel-roll-port\"]\nanswer_to_touch = \"mine\"\nanswer_above = \"5 N\"\nanswer_again = \"20 s\"",
    );
    let scenario = Scenario::read("test.toml", &text)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let made = assemble_traced(&scenario, &library, &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let whale = made.spec.whale.as_ref().unwrap();
    let ids: Vec<&str> = whale.motion.descriptor().acts.iter().map(|act| act.id.as_ref()).collect();
    assert_eq!(ids, ["mine", "barrel-roll-port"]);
    assert!(
        made.files.contains(&"acts/mine.toml".to_owned())
            && made.files.contains(&"acts/barrel-roll.toml".to_owned())
    );
    assert!(!made.files.iter().any(|file| file.ends_with("roll-away.toml")));
}

#[test]
fn a_scenario_that_names_no_acts_has_them_all_and_a_misspelt_one_is_reported() {
    let refused = |acts: &str| {
        let text = scenario(acts);
        let problems = match Scenario::read("test.toml", &text) {
            Err(problems) => problems,
            Ok(scenario) => {
                assemble(&scenario, &library(), &Linked, &Options::default()).err().unwrap()
            }
        };
        assert!(problems.len() == 1 && problems[0].line > 20, "{}", report(&problems));
        problems[0].to_string()
    };
    let all = assemble(
        &Scenario::read("test.toml", &scenario("")).unwrap(),
        &library(),
        &Linked,
        &Options::default(),
    )
    .unwrap();
    assert!(all.whale.unwrap().motion.descriptor().acts.len() > 40);
    for (acts, parts) in [
        (
            "acts = [\"barel-roll\"]",
            ["no act `barel-roll` in acts/", "did you mean `barrel-roll`?"],
        ),
        ("acts = [\"flinch\", \"flinch\"]", ["two acts have the id `flinch`", "each act once"]),
        ("acts = \"flinch\"", ["`acts` is a text, not a list", "[\"roll-away\", \"flinch\"]"]),
        (
            "answer_to_touch = \"flich\"",
            ["no act `flich` to answer a touch with", "did you mean `flinch`?"],
        ),
        (
            "[whale.answers]\ntouched = { none = 1 }\nheld_by_mouth = { none = 1 }\nheld_by_fin = { none = 1 }",
            ["not the time between them", "answer_again = \"20 s\""],
        ),
        (
            "answer_again = \"20 s\"\n[whale.answers]\ntouched = { none = 1 }\nheld_by_mouth = { none = 0 }\nheld_by_fin = { none = 1 }",
            ["no act of `held_by_mouth` has a weight above zero", "such as none = 1"],
        ),
        (
            "answer_again = \"20 s\"\n[whale.answers]\ntouched = { none = 1 }\nheld_by_mouth = { none = 1 }",
            ["`held_by_fin` is missing in `whale.answers`", "{ none = 3, roll-away = 1 }"],
        ),
        (
            "answer_again = \"20 s\"\n[whale.answers]\ntouched = { bollt = 1 }\nheld_by_mouth = { none = 1 }\nheld_by_fin = { none = 1 }",
            ["no act `bollt` to answer a touch with", "did you mean `bolt`?"],
        ),
        (
            "answer_to_touch = \"flinch\"\nanswer_above = \"-1 N\"",
            ["`answer_above` is -1 N", "zero or above"],
        ),
    ] {
        let message = refused(acts);
        assert!(parts.iter().all(|part| message.contains(part)), "{acts}: {message}");
    }
}

/// In a scenario that names every act, each respects the joint limits of the right whale; an act that exceeds them is reported with
/// its place.
#[test]
fn shipped_acts_keep_to_the_right_whales_joints() {
    let ids: Vec<String> = library()
        .acts
        .iter()
        .flat_map(|act| act.clips.iter().map(|clip| format!("\"{}\"", clip.id)))
        .collect();
    let scenario =
        Scenario::read("test.toml", &scenario(&format!("acts = [{}]", ids.join(", ")))).unwrap();
    assemble(&scenario, &library(), &Linked, &Options::default())
        .map(drop)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let mut sources = Sources::from_folder(&root()).unwrap();
    let text =
        sources.get("acts/flippers-abduct.toml").unwrap().replace("\"25 deg\"", "\"50 deg\"");
    sources.set("acts/flippers-abduct.toml", text);
    let problems = assemble(&scenario, &Library::read(&sources).0, &Linked, &Options::default())
        .err()
        .unwrap();
    assert_eq!(
        (problems[0].file.as_str(), problems[0].line),
        ("acts/flippers-abduct.toml", 12),
        "{}",
        report(&problems)
    );
    let message = problems[0].to_string();
    assert!(
        message.contains("sets FlipperRaise(0) to 50.0 deg")
            && message.contains("is -60.0 to 25.0 deg"),
        "{message}"
    );
}
