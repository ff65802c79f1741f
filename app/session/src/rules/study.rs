//! A study of the effect of rules: one assembly, edited to comply with each of several rules, in the same encounters.
//!
//! How encounters are drawn, when a run ends and the sea are those of an existing study; its options are replaced by one for
//! each rule. An option states the changes of its edit in the assembly, so that the study needs no other file.

use endline_gear::{Document, Rule, Setting};

use crate::error::Error;
use crate::plugins::PluginHost;

use super::packs::Packs;
use super::remedy::{Asked, Proposal, least_added};
use super::sheet::Fishing;

/// The study whose encounters are taken where none is named.
pub const USUAL_LIKE: &str = "gear-types";

/// The field of the scenario by which its gear is chosen.
const GEAR: &str = "gear.0.assembly";

/// Lists that speak of the options of the study that was taken, and go with them.
const OF_OPTIONS: [&str; 6] =
    ["option", "claim", "observation", "discretisation", "registered", "enough"];

/// An option of the study.
#[derive(Clone, Debug)]
pub struct RuleOption {
    /// Id of the rule, which is the option's id.
    pub rule: String,
    /// The requirement of the rule.
    pub asks: String,
    /// The edit by which the assembly complies; none where it complies without one.
    pub edit: Option<Proposal>,
}

/// The options for rules: the least edit for each that an option of a study can say.
pub fn options(
    asked: Asked<'_>,
    rules: &[String],
    depth_m: Option<f64>,
    packs: &Packs,
    host: &PluginHost,
) -> Result<Vec<RuleOption>, Error> {
    if rules.len() < 2 {
        return Err(Error::Message("name two rules or more, each by --option".to_owned()));
    }
    let one = |id: &String| {
        let rule = packs.rule(id).map_err(Error::Message)?;
        let fishing = Fishing { depth_m, ..packs.where_applies(rule)? };
        let edit = least_added(asked, id, packs, &fishing, host)?;
        Ok(RuleOption { rule: id.clone(), asks: rule.asks.clone(), edit })
    };
    let options: Vec<RuleOption> = rules.iter().map(one).collect::<Result<_, Error>>()?;
    let text = |option: &RuleOption| option.edit.as_ref().map(|edit| edit.text.clone());
    for (index, option) in options.iter().enumerate() {
        if let Some(same) = options[..index].iter().find(|other| text(other) == text(option)) {
            let message = format!(
                "the same gear meets `{}` and `{}`: there is nothing to compare",
                same.rule, option.rule
            );
            return Err(Error::Message(message));
        }
    }
    Ok(options)
}

/// The text of a study of these options of an assembly, in the encounters of another study.
pub fn text(
    assembly: &str,
    options: &[RuleOption],
    like: &str,
    depth_m: Option<f64>,
) -> Result<String, Error> {
    let mut study = Document::parse(like)?;
    for list in OF_OPTIONS.into_iter().filter(|list| study.has(list)).collect::<Vec<_>>() {
        study.remove(list)?;
    }
    let rules: Vec<&str> = options.iter().map(|option| option.rule.as_str()).collect();
    let name = format!("{assembly}, edited for {}", rules.join(" and "));
    let head =
        [("name", name), ("notes", notes(assembly, options)), ("baseline", rules[0].to_owned())];
    for (field, value) in head {
        study.put(field, &Setting::text(&value))?;
    }
    for (index, option) in options.iter().enumerate() {
        study.push_table("option", &[("id", &option.rule), ("name", &option.asks)])?;
        let mut set = |field: &str, value: &str| {
            let path = format!("option.{index}.set.\"{field}\"");
            study.put(&path, &Setting::plain(value))
        };
        set(GEAR, assembly)?;
        if let Some(depth_m) = depth_m {
            set("site.depth", &format!("{depth_m} m"))?;
        }
        for change in option.edit.iter().flat_map(|edit| &edit.changes) {
            if let Some(after) = &change.after {
                set(&format!("assemblies/{assembly}.{}", change.field), after)?;
            }
        }
    }
    Ok(study.text())
}

/// The question of the study, and its options.
fn notes(assembly: &str, options: &[RuleOption]) -> String {
    let each = options.iter().map(|option| {
        let edit = option.edit.as_ref().map_or("The gear as it stands.", |edit| edit.says.as_str());
        format!("`{}`: {edit}", option.rule)
    });
    let each: Vec<String> = each.collect();
    format!(
        "The assembly `{assembly}` with the least edit by which it complies with each rule, in the same encounters. {} Rates are relative, given an encounter; what a rule costs to fish is not in them.",
        each.join(" ")
    )
}

impl Packs {
    /// A rule by its id.
    pub fn rule(&self, id: &str) -> Result<&Rule, String> {
        let found = self.rules().map(|(_, rule)| rule).find(|rule| rule.id.value == id);
        let known = || self.rules().map(|(_, rule)| rule.id.value.as_str());
        found.ok_or_else(|| format!("there is no rule `{id}`; {}", endline_gear::hint(id, known())))
    }

    /// Somewhere and some day where a rule applies: its first area, its first day, its least distance.
    fn where_applies(&self, rule: &Rule) -> Result<Fishing, Error> {
        let nowhere = || Error::Message("no pack declares an area".to_owned());
        let first = || self.areas().next().map(|area| area.id.value.clone());
        let area = rule.areas.first().map(|area| area.value.clone()).or_else(first);
        let day = rule
            .day_in_force()
            .ok_or_else(|| Error::Message(format!("`{}` applies on no day", rule.id.value)))?;
        Ok(Fishing {
            area: area.ok_or_else(nowhere)?,
            on: day,
            depth_m: None,
            distance_m: rule.distance_m.map(|[least, _]| least),
            traps: None,
        })
    }
}
