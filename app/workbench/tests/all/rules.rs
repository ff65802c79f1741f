//! The panel Rules: an assembly checked, an edit applied and undone, the compliance sheet, options compared in a study.

use egui_kittest::kittest::Queryable;
use endline_session::command::{EditAction, RuleAction};
use endline_session::edit::Documents;
use endline_session::rules::Verdict;
use endline_session::workbench::{Folders, RuleAnswer, RuleQuestion};
use endline_workbench::gui::panel::PanelId;

use crate::common::{Folder, Reach as _, Window, give, on_disk, real, retype, wait};

const ASSEMBLY: &str = "assemblies/single.toml";
const TWO: &str = "me.inserts.3-12.two";
const ONE: &str = "me.inserts.3-12.one";

/// The workbench with only the panel Rules, which checks the single in zone B of Maine.
fn checking(folder: &Folder) -> Window {
    let shipped = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
    std::fs::create_dir_all(folder.0.join("studies")).unwrap();
    let study = "studies/gear-types.toml";
    std::fs::copy(shipped.join(study), folder.0.join(study)).unwrap();
    let mut harness = real(folder, "hello-endline");
    harness.state_mut().dock = egui_dock::DockState::new(vec![PanelId::Rules.id().to_owned()]);
    ask(&mut harness, |question| {
        "single".clone_into(&mut question.assembly);
        "me-b".clone_into(&mut question.area);
    });
    harness.run_steps(3);
    harness
}

/// Asks about another place, day or gear.
fn ask(harness: &mut Window, change: impl FnOnce(&mut RuleQuestion)) {
    let mut question = harness.workbench().rules().question.clone();
    change(&mut question);
    harness.perform(RuleAction::Ask(question));
}

fn answer(harness: &Window) -> Option<&RuleAnswer> {
    harness.workbench().rules().answer.as_ref()
}

/// Draws until the edits for the current question have been tried.
fn wait_for_edits(harness: &mut Window) {
    wait(harness, |app| {
        let (rules, documents) =
            (&app.shared.workbench.rules(), &app.shared.workbench.project().documents);
        let so = |one: &RuleAnswer| {
            one.remedies.is_some()
                && one.question == rules.question
                && one.version == documents.version()
        };
        rules.answer.as_ref().is_some_and(so) && !rules.busy()
    });
}

fn verdict(harness: &Window, rule: &str) -> Verdict {
    let sheet = &answer(harness).unwrap().sheet;
    sheet.rules.iter().find(|one| one.rule == rule).unwrap().verdict
}

#[test]
fn an_edit_for_a_rule_is_applied_by_a_button_and_undone() {
    let folder = Folder::new("rules");
    let mut harness = checking(&folder);
    wait_for_edits(&mut harness);
    let today = harness.workbench().rules().question.on.clone();
    retype(&mut harness, &today, "June");
    wait(&mut harness, |app| !app.shared.workbench.rules().why.is_empty());
    assert!(harness.query_all_by_label_contains("day `June`").next().is_some());
    retype(&mut harness, "June", "2024-06-01");
    wait_for_edits(&mut harness);
    assert_eq!(verdict(&harness, TWO), Verdict::CannotBeChecked, "the distance is unknown");
    ask(&mut harness, |question| question.distance = "5 nmi".to_owned());
    wait_for_edits(&mut harness);
    assert_eq!(verdict(&harness, TWO), Verdict::Fail);

    harness.state_mut().panels.rules.chosen = Some(TWO.to_owned());
    harness.run_steps(3);
    let remedies = answer(&harness).unwrap().remedies.clone().unwrap();
    let edits = &remedies.rules.iter().find(|one| one.rule == TWO).unwrap().proposals;
    let says = &edits[0].says;
    assert!(harness.query_all_by_label_contains(says).next().is_some(), "{says}");
    let before = on_disk(&folder, ASSEMBLY);
    let text = |harness: &Window| {
        let documents = harness.documents();
        documents.text(ASSEMBLY).unwrap().to_owned()
    };
    harness.get_all_by_label("Apply this edit").next().unwrap().click();
    harness.run_steps(3);
    assert_eq!(text(&harness), edits[0].text);
    wait_for_edits(&mut harness);
    assert_eq!(verdict(&harness, TWO), Verdict::Pass);
    give(&mut harness, EditAction::Undo);
    assert_eq!(text(&harness), before, "one undo");
    // The file is not written before Save.
    assert_eq!(on_disk(&folder, ASSEMBLY), before);

    wait_for_edits(&mut harness);
    give(&mut harness, RuleAction::TakeAll);
    wait_for_edits(&mut harness);
    assert_eq!(answer(&harness).unwrap().sheet.counts.fail_binding, 0);
    let open = harness.query_all_by_label_contains("No verdict yet").next();
    assert!(open.is_some(), "facts of the gear are missing for some rules that bind");
}

#[test]
fn an_opened_scenario_is_checked_with_its_own_gear() {
    let folder = Folder::new("rules-scenario");
    let mut harness = checking(&folder);
    let question_after_opening = |harness: &mut Window, scenario: &str| {
        let path = folder.0.join("scenarios").join(scenario).with_extension("toml");
        harness.perform(EditAction::OpenScenario(path));
        wait(harness, |app| !app.shared.workbench.rules().busy());
        harness.workbench().rules().question.assembly.clone()
    };
    let place = |harness: &Window| {
        let question = &harness.workbench().rules().question;
        [question.area.clone(), question.depth.clone()]
    };
    assert_eq!(place(&harness), ["me-b", "25 m"], "the area that was chosen, the site's depth");
    harness.set(Documents::SCENARIO, "site.depth", "35 m");
    harness.run_steps(3);
    assert_eq!(place(&harness), ["me-b", "35 m"]);
    ask(&mut harness, |question| question.depth = "20 m".to_owned());
    harness.set(Documents::SCENARIO, "site.depth", "36 m");
    harness.run_steps(3);
    assert_eq!(place(&harness), ["me-b", "20 m"], "a depth that was typed stays");
    give(&mut harness, EditAction::Save);
    assert_eq!(question_after_opening(&mut harness, "trawl-10"), "trawl-10");
    assert_eq!(
        question_after_opening(&mut harness, "study-endline-held"),
        "",
        "it has its own parts, no assembly"
    );
    let why = &harness.workbench().rules().why;
    assert!(why.contains("choose an assembly"), "{why}");
    assert_eq!(question_after_opening(&mut harness, "hello-endline"), "single");
}

#[test]
fn a_button_writes_the_compliance_sheet_for_the_question_on_screen() {
    let folder = Folder::new("rules-sheet");
    let mut harness = checking(&folder);
    harness
        .workbench_mut()
        .write_to(Folders { studies: Some(folder.0.join("results")), ..Folders::default() });
    ask(&mut harness, |question| question.on = "2024-06-01".to_owned());
    wait_for_edits(&mut harness);
    harness.get_by_label("Compliance sheet").click();
    wait(&mut harness, |app| app.shared.workbench.rules().page().is_some());
    let page = harness.workbench().rules().page().unwrap().to_owned();
    assert!(page.ends_with("results/sheets/single-me-b-2024-06-01.html"), "{}", page.display());
    let text = std::fs::read_to_string(&page).unwrap();
    let hauled = "at the hauler, with 1 of its traps and anchors off the seabed";
    for line in ["endline sheet single --area me-b --on 2024-06-01", hauled] {
        assert!(text.contains(line), "{line}: {text}");
    }
    let offered = |harness: &Window| {
        ["Open it", "Open the outdated sheet"].map(|label| harness.query_by_label(label).is_some())
    };
    assert_eq!(offered(&harness), [true, false]);
    let copy = folder.0.join("for the hearing.html");
    give(&mut harness, RuleAction::SaveSheet(copy.clone()));
    wait(&mut harness, |app| !app.shared.workbench.rules().saving());
    assert_eq!(std::fs::read_to_string(&copy).unwrap(), text);
    give(&mut harness, RuleAction::TakeAll);
    wait_for_edits(&mut harness);
    assert_eq!(offered(&harness), [false, true], "the gear has been edited since");
    give(&mut harness, EditAction::Undo);
    wait_for_edits(&mut harness);
    assert_eq!(offered(&harness), [true, false]);
    ask(&mut harness, |question| question.distance = "5 nmi".to_owned());
    wait_for_edits(&mut harness);
    assert_eq!(offered(&harness), [false, true], "the distance has changed since");
}

#[test]
fn two_ticked_rules_become_a_study_with_an_option_for_each() {
    let folder = Folder::new("rules-study");
    let mut harness = checking(&folder);
    wait_for_edits(&mut harness);
    ask(&mut harness, |question| question.distance = "5 nmi".to_owned());
    wait_for_edits(&mut harness);
    harness.get_by_label(&format!("compare {TWO}")).click();
    harness.run_steps(3);
    assert_eq!(harness.state().panels.rules.compared, [TWO]);
    // The rule of another zone is in the list of rules that do not apply.
    harness.state_mut().panels.rules.compared.push(ONE.to_owned());
    harness.run_steps(2);
    harness.get_by_label("Compare 2 options …").click();
    wait(&mut harness, |app| app.shared.workbench.project().documents.study_path().is_some());
    let workbench = harness.workbench();
    let documents = &workbench.project().documents;
    assert!(workbench.study_is_sound(), "{:?}", documents.problems());
    assert!(documents.study_path().unwrap().ends_with("studies/single-rules.toml"));
    let option = |index: usize| documents.field(Documents::STUDY, &format!("option.{index}.id"));
    assert_eq!([option(0), option(1), option(2)], [Some(TWO.into()), Some(ONE.into()), None]);
    assert!(harness.state().shared.selection.open.contains(&PanelId::Study));
}
