//! The rules of a user: an assembly checked where and when it is fished, the edits by which it would comply, the study
//! made of options for rules, and its compliance sheet.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use endline_gear::units::{self, Quantity};
use endline_gear::{Date, Sources};

use super::Workbench;
use super::notice::Notice;
use crate::compliance::{ComplianceSheet, Request, USUAL_TIDE_M_S, print_pdf};
use crate::edit::Documents;
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::rules::remedy::{self, Asked, Proposal, Remedies};
use crate::rules::study::{self, USUAL_LIKE};
use crate::rules::{Fishing, Packs, RuleSheet};
use crate::save;
use crate::task::{Fault, Task};

/// Seconds in a day.
const DAY_S: u64 = 86_400;

/// What is said where the scenario places no assembly.
const CHOOSE: &str = "choose an assembly: rules are checked on those of the library";

/// What is asked, as it is typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleQuestion {
    /// Id of the assembly.
    pub assembly: String,
    /// Id of the area.
    pub area: String,
    /// The day.
    pub on: String,
    /// Depth of the water; empty where it is not known.
    pub depth: String,
    /// Distance from shore; empty where it is not known.
    pub distance: String,
    /// Traps on one set; empty for those of the assembly.
    pub traps: String,
}

impl Default for RuleQuestion {
    fn default() -> Self {
        let empty = String::new;
        let on = today();
        Self {
            assembly: empty(),
            area: empty(),
            on,
            depth: empty(),
            distance: empty(),
            traps: empty(),
        }
    }
}

/// What the rules say of an assembly.
#[derive(Clone, Debug)]
pub struct RuleAnswer {
    /// What was asked.
    pub question: RuleQuestion,
    /// Version of the texts.
    pub version: u64,
    /// Verdicts on every rule.
    pub sheet: RuleSheet,
    /// Edits by which the assembly would comply; none while they are tried.
    pub remedies: Option<Remedies>,
    given: Given,
}

/// The assembly as it was checked.
#[derive(Clone, Debug)]
struct Given {
    text: String,
    sources: Arc<Sources>,
    fishing: Fishing,
}

type Checked = Result<(Arc<Packs>, RuleAnswer), String>;

/// A compliance sheet, with what it was written from.
#[derive(Clone, Debug)]
struct WrittenSheet {
    page: PathBuf,
    question: RuleQuestion,
    given: Given,
    packs: Arc<Packs>,
    /// Whether it is outdated, computed for a version of the texts.
    outdated: Cell<Option<(u64, bool)>>,
}

/// Rules checked on an assembly.
#[derive(Default)]
pub struct RuleChecks {
    /// What is asked.
    pub question: RuleQuestion,
    /// The library's packs, once they were read.
    pub packs: Option<Arc<Packs>>,
    /// What came of it last.
    pub answer: Option<RuleAnswer>,
    /// Why nothing came of it; empty where something did.
    pub why: String,
    asked: Option<(u64, RuleQuestion)>,
    /// The scenario that was open when it was asked last.
    scenario: Option<PathBuf>,
    /// Depth of its site; empty where it is not known.
    scenario_depth: String,
    checking: Task<Checked>,
    finding_remedies: Task<Result<Remedies, String>>,
    comparing: Task<Result<String, String>>,
    sheet: Option<WrittenSheet>,
    writing: Task<Result<WrittenSheet, String>>,
    saving: Task<Result<PathBuf, String>>,
}

impl RuleChecks {
    /// Whether verdicts or edits are being found.
    pub fn busy(&self) -> bool {
        self.checking.busy() || self.finding_remedies.busy()
    }

    /// Whether a study is being made.
    pub fn comparing(&self) -> bool {
        self.comparing.busy()
    }

    /// Whether a compliance sheet is being written.
    pub fn writing(&self) -> bool {
        self.writing.busy()
    }

    /// Whether the compliance sheet is being saved under a name.
    pub fn saving(&self) -> bool {
        self.saving.busy()
    }

    /// The page of the compliance sheet written last.
    pub fn page(&self) -> Option<&Path> {
        self.sheet.as_ref().map(|sheet| sheet.page.as_path())
    }

    /// A proposal by its place among all, or all edits together.
    fn proposal(&self, number: Option<usize>) -> Option<&Proposal> {
        let remedies = self.answer.as_ref()?.remedies.as_ref()?;
        match number {
            Some(number) => remedies.numbered().nth(number).map(|(_, edit)| edit),
            None => remedies.all.as_ref(),
        }
    }
}

impl Workbench {
    /// Asks for the verdicts where the texts or the question have changed since.
    pub(super) fn ask_for_rules(&mut self) {
        let version = self.project.documents.version();
        let checks = &mut self.rules;
        // Another scenario asks about its own gear, whatever was chosen before.
        let open = self.project.documents.scenario_path();
        let is_another = checks.scenario.as_deref().is_some_and(|before| before != open);
        if is_another || checks.question.assembly.is_empty() {
            let placed = self.project.documents.field(Documents::SCENARIO, "gear.0.assembly");
            checks.question.assembly = placed.unwrap_or_default();
        }
        let depth = scenario_depth(&self.project.documents).unwrap_or_default();
        // A depth that was typed here stays until another scenario is opened.
        if is_another || checks.question.depth == checks.scenario_depth {
            checks.question.depth.clone_from(&depth);
        }
        checks.scenario_depth = depth;
        if is_another
            && let Some(area) = area_of_scenario(&self.project.documents, checks.packs.as_deref())
        {
            checks.question.area = area;
        }
        checks.scenario = Some(open.to_owned());
        let wanted = (version, checks.question.clone());
        if checks.asked.as_ref() == Some(&wanted) || checks.busy() {
            return;
        }
        checks.asked = Some(wanted);
        if let Err(why) = self.begin_check() {
            self.rules.why = why;
            (self.waker)();
        }
    }

    fn begin_check(&mut self) -> Result<(), String> {
        let (host, waker) = self.helpers();
        let documents = &self.project.documents;
        let question = self.rules.question.clone();
        let path = path(&question.assembly);
        let text = documents.text(&path).ok_or(CHOOSE)?.to_owned();
        let (sources, root) = (Arc::new(documents.sources()), documents.root().to_owned());
        let version = documents.version();
        let known = self.rules.packs.clone();
        let site = documents.field(Documents::SCENARIO, "site.item").unwrap_or_default();
        let work = move || {
            let packs = match known {
                Some(packs) => packs,
                None => Packs::open(Some(&root), &[])
                    .map(Arc::new)
                    .map_err(|error| error.to_string())?,
            };
            let question = with_area(question, &packs, &site);
            let fishing = fishing(&question)?;
            let given = Given { text, sources, fishing };
            let sheet = remedy::checked(given.asked(&question), &packs, &given.fishing, &host);
            let sheet = sheet.map_err(|error| error.to_string())?;
            Ok((packs, RuleAnswer { question, version, sheet, remedies: None, given }))
        };
        let started = self.rules.checking.start("endline-rules", work, waker);
        started.map_err(|error| error.to_string())
    }

    /// Takes in verdicts, edits and studies that are ready.
    pub(super) fn refresh_rules(&mut self) {
        if let Some(checked) = self.rules.checking.poll() {
            self.take_verdicts(checked.unwrap_or_else(|Fault| Err(fault("the check"))));
        }
        if let Some(remedies) = self.rules.finding_remedies.poll() {
            match remedies.unwrap_or_else(|Fault| Err(fault("looking for edits"))) {
                Ok(remedies) => {
                    self.rules
                        .answer
                        .iter_mut()
                        .for_each(|answer| answer.remedies = Some(remedies.clone()));
                }
                Err(why) => self.rules.why = why,
            }
        }
        if let Some(page) = self.rules.writing.poll() {
            let page = page.unwrap_or_else(|Fault| Err(fault("writing the sheet")));
            self.take_sheet(page);
        }
        if let Some(saved) = self.rules.saving.poll() {
            let saved = saved.unwrap_or_else(|Fault| Err(fault("saving the sheet")));
            self.notice = Some(match saved {
                Ok(file) => {
                    Notice::done(format!("the compliance sheet is saved as {}", file.display()))
                }
                Err(why) => Notice::fault(why),
            });
        }
        if let Some(text) = self.rules.comparing.poll() {
            let text = text.unwrap_or_else(|Fault| Err(fault("making the study")));
            let done = text.and_then(|text| self.open_rule_study(&text));
            self.notice = Some(match done {
                Ok(path) => Notice::done(format!("a study of the options: {}", path.display())),
                Err(why) => Notice::fault(why),
            });
        }
    }

    fn take_sheet(&mut self, written: Result<WrittenSheet, String>) {
        match written {
            Ok(sheet) => {
                let said = format!("the compliance sheet is {}", sheet.page.display());
                self.notice = Some(Notice::done(said));
                self.rules.sheet = Some(sheet);
            }
            Err(why) => self.notice = Some(Notice::fault(why)),
        }
    }

    /// Whether the gear, the place or the rules have changed since the compliance sheet was written.
    pub fn sheet_is_outdated(&self) -> bool {
        let (documents, checks) = (&self.project.documents, &self.rules);
        let Some(sheet) = &checks.sheet else { return false };
        let same_rules = checks.packs.as_ref().is_some_and(|now| Arc::ptr_eq(now, &sheet.packs));
        if checks.question != sheet.question || !same_rules {
            return true;
        }
        let version = documents.version();
        if let Some((_, outdated)) = sheet.outdated.get().filter(|(known, _)| *known == version) {
            return outdated;
        }
        let text = documents.text(&path(&sheet.question.assembly));
        let outdated =
            text != Some(sheet.given.text.as_str()) || documents.sources() != *sheet.given.sources;
        sheet.outdated.set(Some((version, outdated)));
        outdated
    }

    fn take_verdicts(&mut self, checked: Checked) {
        let (packs, answer) = match checked {
            Ok(both) => both,
            Err(why) => {
                self.rules.why = why;
                return;
            }
        };
        let (host, waker) = self.helpers();
        let checks = &mut self.rules;
        // The default area is used as if it were chosen.
        if checks.question.area.is_empty() {
            checks.question.area.clone_from(&answer.question.area);
            checks.asked = Some((answer.version, checks.question.clone()));
        }
        checks.why.clear();
        checks.packs = Some(Arc::clone(&packs));
        let (given, question) = (answer.given.clone(), answer.question.clone());
        checks.answer = Some(answer);
        let work = move || {
            let remedies = remedy::remedies(given.asked(&question), &packs, &given.fishing, &host);
            remedies.map_err(|error| error.to_string())
        };
        if let Err(error) = checks.finding_remedies.start("endline-remedies", work, waker) {
            checks.why = error.to_string();
        }
    }

    /// Makes an edit of the assembly that was proposed, by its place among all proposals, or all that bind together.
    pub(crate) fn take_rule_edit(&mut self, number: Option<usize>) -> Result<(), String> {
        let answer = self.rules.answer.as_ref().ok_or("no assembly was checked")?;
        let edit = self.rules.proposal(number).ok_or("there is no such edit")?;
        let path = path(&answer.question.assembly);
        if self.project.documents.text(&path) != Some(answer.given.text.as_str()) {
            return Err(
                "the assembly was edited since it was checked; wait for its new edits".to_owned()
            );
        }
        let (says, text) = (edit.says.clone(), edit.text.clone());
        self.project.documents.put_all(vec![(path, text)]);
        self.notice = Some(Notice::done(format!("{says} Undo takes it back.")));
        Ok(())
    }

    /// Makes a study of the assembly edited for each of several rules. The study is written to a new file; nothing else is saved.
    pub(crate) fn compare_rules(&mut self, rules: Vec<String>) -> Result<(), String> {
        let answer = self.rules.answer.as_ref().ok_or("no assembly was checked")?;
        let (question, given) = (answer.question.clone(), answer.given.clone());
        let packs = self.rules.packs.clone().ok_or("no rules were read")?;
        let documents = &self.project.documents;
        let like = documents.root().join("studies").join(USUAL_LIKE).with_extension("toml");
        let like = endline_gear::read::text(&like)
            .map_err(|error| format!("{}: {error}; its encounters are taken", like.display()))?;
        let (host, waker) = self.helpers();
        let work = move || rule_study(&question, &given, &rules, &packs, &like, &host);
        let started = self.rules.comparing.start("endline-rule-study", work, waker);
        started.map_err(|error| error.to_string())
    }

    /// Writes the compliance sheet of the assembly checked into the folder of results.
    pub(crate) fn write_sheet(&mut self) -> Result<(), String> {
        let answer = self.rules.answer.as_ref().ok_or("no assembly was checked")?;
        let (question, given) = (answer.question.clone(), answer.given.clone());
        let packs = self.rules.packs.clone().ok_or("no rules were read")?;
        let folder = self.studies.root().join("sheets");
        let (host, waker) = self.helpers();
        let work = move || {
            let page = sheet(&question, &given, &packs, &folder, &host)?;
            Ok(WrittenSheet { page, question, given, packs, outdated: Cell::default() })
        };
        let started = self.rules.writing.start("endline-sheet", work, waker);
        started.map_err(|error| error.to_string())
    }

    /// Saves the sheet written last: as it is, or printed if the file's name ends in `.pdf`.
    pub(crate) fn save_sheet(&mut self, file: PathBuf) -> Result<(), String> {
        let page = self.rules.page().ok_or("no compliance sheet was written")?.to_owned();
        let prints =
            file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("pdf"));
        let work = move || {
            let saved = if prints { print_pdf(&page, &file) } else { copied(&page, &file) };
            saved.map(|()| file).map_err(|error| error.to_string())
        };
        let started = self.rules.saving.start("endline-sheet-file", work, Arc::clone(&self.waker));
        started.map_err(|error| error.to_string())
    }

    fn open_rule_study(&mut self, text: &str) -> Result<PathBuf, String> {
        let stem = format!("{}-rules", self.rules.question.assembly);
        let path = self.project.documents.new_study(&stem, text)?;
        self.open_study(&path)?;
        Ok(path)
    }
}

/// Writes a copy of a page.
fn copied(page: &Path, file: &Path) -> Result<(), Error> {
    let at = |place: &Path, error: std::io::Error| Error::at(place, error.to_string());
    let bytes = endline_gear::read::bytes(page).map_err(|error| at(page, error))?;
    save::atomically(file, &bytes).map_err(|error| at(file, error))
}

/// Writes a sheet, named by its gear, area and day; answers where it is.
fn sheet(
    question: &RuleQuestion,
    given: &Given,
    packs: &Packs,
    folder: &Path,
    host: &PluginHost,
) -> Result<PathBuf, String> {
    let request = Request {
        assembly: &question.assembly,
        sources: &given.sources,
        fishing: given.fishing.clone(),
        tide_m_s: USUAL_TIDE_M_S,
        threat: None,
    };
    let sheet = ComplianceSheet::of(&request, packs, host).map_err(|error| error.to_string())?;
    let RuleQuestion { assembly, area, on, .. } = question;
    let page = folder.join(format!("{assembly}-{area}-{on}.html"));
    let html = sheet.html().map_err(|error| error.to_string())?;
    std::fs::create_dir_all(folder)
        .and_then(|()| save::atomically(&page, html.as_bytes()))
        .map_err(|error| format!("{}: cannot be written: {error}", page.display()))?;
    Ok(page)
}

fn rule_study(
    question: &RuleQuestion,
    given: &Given,
    rules: &[String],
    packs: &Packs,
    like: &str,
    host: &PluginHost,
) -> Result<String, String> {
    let depth_m = given.fishing.depth_m;
    let made = study::options(given.asked(question), rules, depth_m, packs, host)
        .and_then(|options| study::text(&question.assembly, &options, like, depth_m));
    made.map_err(|error| error.to_string())
}

impl Given {
    fn asked<'a>(&'a self, question: &'a RuleQuestion) -> Asked<'a> {
        Asked { id: &question.assembly, text: &self.text, sources: &self.sources }
    }
}

fn path(assembly: &str) -> String {
    format!("assemblies/{assembly}.toml")
}

fn fault(what: &str) -> String {
    format!("{what} ended by a fault inside the program")
}

/// Depth of the open scenario: its own, or that of its site; `None` if it has none that can be read.
fn scenario_depth(documents: &Documents) -> Option<String> {
    let field = |field| documents.field(Documents::SCENARIO, field);
    let own = field("site.depth").filter(|text| units::parse(text, Quantity::Length).is_ok());
    let of_site = || {
        let id = field("site.item")?;
        let library = documents.library();
        let site = library.sites.iter().find(|site| site.entry.id == id)?;
        Some(units::format_si(site.depth_m, Quantity::Length))
    };
    own.or_else(of_site)
}

/// Area in which the site of the open scenario lies; `None` if it is not known.
fn area_of_scenario(documents: &Documents, packs: Option<&Packs>) -> Option<String> {
    let site = documents.field(Documents::SCENARIO, "site.item")?;
    packs?.area_of_site(&site).map(str::to_owned)
}

/// With the area of a site where none was chosen; if that is not known, with the area where most rules apply.
fn with_area(question: RuleQuestion, packs: &Packs, site: &str) -> RuleQuestion {
    if !question.area.is_empty() {
        return question;
    }
    if let Some(area) = packs.area_of_site(site) {
        return RuleQuestion { area: area.to_owned(), ..question };
    }
    let rules_in = |id: &str| {
        let around = packs.around(id).unwrap_or_default();
        let holds = |area: &endline_gear::At<String>| around.contains(&area.value.as_str());
        packs
            .rules()
            .filter(|(_, rule)| rule.areas.is_empty() || rule.areas.iter().any(holds))
            .count()
    };
    let mut ids: Vec<&str> = packs.areas().map(|area| area.id.value.as_str()).collect();
    // The first of those with as many.
    ids.reverse();
    let most = ids.into_iter().max_by_key(|id| rules_in(id)).unwrap_or_default();
    RuleQuestion { area: most.to_owned(), ..question }
}

/// Where, when and how, read from what was typed.
fn fishing(question: &RuleQuestion) -> Result<Fishing, String> {
    let length = |name: &str, text: &str| match text.trim() {
        "" => Ok(None),
        text => units::parse(text, Quantity::Length)
            .map(Some)
            .map_err(|error| format!("{name} `{text}`: {error}")),
    };
    let on = question.on.trim();
    let traps = match question.traps.trim() {
        "" => None,
        text => Some(text.parse().map_err(|_| format!("traps `{text}`: write a whole number"))?),
    };
    Ok(Fishing {
        area: question.area.clone(),
        on: Date::parse(on)
            .ok_or_else(|| format!("day `{on}`: write year, month and day, such as 2024-06-01"))?,
        depth_m: length("depth", &question.depth)?,
        distance_m: length("distance", &question.distance)?,
        traps,
    })
}

/// The day that it is, in universal time.
fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    Date::after_1970(since.as_secs() / DAY_S).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed_is_read_with_its_units_or_refused_by_name() {
        let typed = RuleQuestion {
            area: "me-b".to_owned(),
            on: " 2024-06-01".to_owned(),
            distance: "5 nmi".to_owned(),
            traps: "8".to_owned(),
            ..RuleQuestion::default()
        };
        let read = fishing(&typed).unwrap();
        assert_eq!((read.distance_m, read.depth_m, read.traps), (Some(9260.0), None, Some(8)));
        for (wrong, message) in [
            (RuleQuestion { on: "June".to_owned(), ..typed.clone() }, "day `June`"),
            (RuleQuestion { depth: "5 lbf".to_owned(), ..typed.clone() }, "depth `5 lbf`"),
            (RuleQuestion { traps: "few".to_owned(), ..typed.clone() }, "traps `few`"),
        ] {
            assert!(fishing(&wrong).unwrap_err().starts_with(message), "{message}");
        }
        assert!(Date::parse(&today()) > Date::parse("2025-01-01"));
    }
}
