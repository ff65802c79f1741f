//! Spots on the whale for the ends of lines: `whale:peduncle`, `whale:mouth-left` and so on.
//!
//! A spot is a triangle of its regions: the outermost one in a direction near a place along the body, or the middle one.

use endline_sdk::Region;
use endline_sim::model::{Hitch, Joint, JointKind};
use endline_sim::whale::Skin;
use endline_sim::{DAffine3, DVec3};

use crate::diagnostic::{At, hint};
use crate::whale::WhaleForm;

use super::builder::Builder;

/// Distance of the rope's centre line from the skin [m].
const STAND_OFF_M: f64 = 0.03;
/// Penalty on the distance from the place along the body, in outward distance [m/m].
const STRAY: f64 = 2.0;

/// A spot for the end of a line.
struct Spot {
    name: &'static str,
    regions: &'static [Region],
    /// Outward direction: the farthest triangle counts.
    toward: DVec3,
    /// Place along the body, as a share of length from the snout; `None` for the middle of the regions.
    at: fn(&WhaleForm) -> Option<f64>,
}

const PORT: DVec3 = DVec3::Y;
const STARBOARD: DVec3 = DVec3::NEG_Y;
const UP: DVec3 = DVec3::Z;

const MOUTH: &[Region] = &[Region::Lips, Region::Baleen, Region::Head];

const SNOUT: &[Region] = &[Region::Rostrum, Region::Head, Region::Lips];

const fn spot(
    name: &'static str,
    regions: &'static [Region],
    toward: DVec3,
    at: fn(&WhaleForm) -> Option<f64>,
) -> Spot {
    Spot { name, regions, toward, at }
}

/// Every spot.
const SPOTS: [Spot; 10] = [
    spot("peduncle", &[Region::Peduncle], UP, |_| Some(0.86)),
    spot("snout", SNOUT, DVec3::X, |_| Some(0.0)),
    spot("mouth-left", MOUTH, PORT, |form| Some(form.head.mouth)),
    spot("mouth-right", MOUTH, STARBOARD, |form| Some(form.head.mouth)),
    spot("flipper-left", &[Region::LeftFlipperLeading], UP, |_| None),
    spot("flipper-right", &[Region::RightFlipperLeading], UP, |_| None),
    spot("fluke-left", &[Region::LeftFlukeLeading], DVec3::X, |_| None),
    spot("fluke-right", &[Region::RightFlukeLeading], DVec3::X, |_| None),
    spot("back", &[Region::Body], UP, |_| Some(0.5)),
    spot("belly", &[Region::Body], DVec3::NEG_Z, |_| Some(0.5)),
];

impl Builder<'_> {
    /// The joint at a spot of the whale, shared by all lines there.
    pub fn whale_joint(&mut self, spot: Option<&str>, end: &At<String>) -> Option<usize> {
        let name = spot.unwrap_or_default();
        let id = format!("whale:{name}");
        if let Some(joint) = self.spec.joints.iter().position(|joint| joint.id == id) {
            return Some(joint);
        }
        let hitch = Hitch { stand_off_m: STAND_OFF_M, ..self.whale_spot(name, end)? };
        let whale = self.spec.whale.as_ref()?;
        let frame = DAffine3::from_rotation_translation(whale.orientation, whale.position_m);
        let bones = vec![frame; whale.skin.bones.len()];
        let position_m = hitch.place(&whale.skin, &bones);
        self.spec.joints.push(Joint { id, kind: JointKind::Whale(hitch), position_m });
        Some(self.spec.joints.len() - 1)
    }

    /// Whether the model has a whale; reports that it has none, at a name of it.
    pub fn whale_placed(&self, at: &At<String>) -> bool {
        // A failed whale has been reported.
        if self.spec.whale.is_none() && self.scenario.whale.is_none() {
            let help = "add a [whale], or name a body or joint";
            self.problems.push(at.place.error("the scenario has no whale", help));
        }
        self.spec.whale.is_some()
    }

    /// The point of the skin at a spot of the whale.
    pub fn whale_spot(&self, name: &str, at: &At<String>) -> Option<Hitch> {
        if !self.whale_placed(at) {
            return None;
        }
        let whale = self.spec.whale.as_ref()?;
        let spots = || SPOTS.iter().map(|spot| spot.name);
        let Some(found) = SPOTS.iter().find(|known| known.name == name) else {
            let message = format!("the whale has no spot `{name}`");
            return self.problems.refuse(at.place.error(message, hint(name, spots())));
        };
        let placed = self.scenario.whale.as_ref()?;
        let form =
            &self.library.whales.iter().find(|item| item.entry.id == placed.item.value)?.form;
        let Some(triangle) = found.on(&whale.skin, form, whale.length_m) else {
            let message = format!("the skin of this whale has no triangle at `{name}`");
            return self.problems.refuse(at.place.error(message, hint("", spots())));
        };
        Some(Hitch { triangle, barycentric: [1.0 / 3.0; 3], stand_off_m: 0.0 })
    }
}

impl Spot {
    /// The triangle of this spot.
    fn on(&self, skin: &Skin, form: &WhaleForm, length_m: f64) -> Option<usize> {
        let middle = |triangle: usize| {
            skin.triangles[triangle]
                .iter()
                .map(|corner| skin.vertices[*corner as usize])
                .sum::<DVec3>()
                / 3.0
        };
        let there = (0..skin.triangles.len())
            .filter(|triangle| self.regions.contains(&skin.regions[*triangle]));
        let there: Vec<(usize, DVec3)> =
            there.map(|triangle| (triangle, middle(triangle))).collect();
        let best =
            |(_, one): &&(usize, DVec3),
             (_, other): &&(usize, DVec3),
             toward: &dyn Fn(DVec3) -> f64| { toward(*one).total_cmp(&toward(*other)) };
        let found = match (self.at)(form) {
            Some(at) => {
                let score = |place: DVec3| {
                    place.dot(self.toward) - STRAY * (place.x - (0.5 - at) * length_m).abs()
                };
                there.iter().max_by(|one, other| best(one, other, &score))
            }
            None => {
                let mean = there.iter().map(|(_, place)| *place).sum::<DVec3>()
                    / there.len().max(1) as f64;
                there.iter().max_by(|one, other| best(one, other, &|place| -place.distance(mean)))
            }
        };
        found.map(|(triangle, _)| *triangle)
    }
}
