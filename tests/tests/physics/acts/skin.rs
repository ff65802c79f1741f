//! What the posed skin does in the four motions of the flippers, and with an open mouth: seen in its own vertices.

use endline_sdk::Posture;
use endline_sim::whale::{Skin, pose, skin_vertex};
use endline_sim::{DAffine3, DQuat, DVec3};

use crate::acts::flight::clips;
use crate::linked::library;

struct Posed {
    skin: Skin,
    bones: Vec<DAffine3>,
    rest: Vec<DAffine3>,
}

impl Posed {
    fn holding(id: &str) -> Self {
        let library = library();
        let whale = library.whales.iter().find(|whale| whale.entry.id == "right-whale").unwrap();
        let skin = endline_gear::whale::build_skin(&whale.form_at(13.7));
        let clip = clips().into_iter().find(|clip| clip.id == id).unwrap();
        let (mut bones, mut rest) = (Vec::new(), Vec::new());
        let posture = clip.posture(clip.length_s, false, &Posture::default());
        pose(&skin, DVec3::ZERO, DQuat::IDENTITY, &posture, &mut bones);
        pose(&skin, DVec3::ZERO, DQuat::IDENTITY, &Posture::default(), &mut rest);
        Self { skin, bones, rest }
    }

    /// How far the left flipper's outermost vertex moves [m].
    fn tip(&self) -> DVec3 {
        self.moved(self.flipper(0.8, |v| v.y))
    }

    /// How far the leading and the trailing edge of the left flipper's outer half move up [m].
    fn edges(&self) -> [f64; 2] {
        [self.flipper(0.5, |v| v.x), self.flipper(0.5, |v| -v.x)].map(|vertex| self.moved(vertex).z)
    }

    fn moved(&self, vertex: usize) -> DVec3 {
        skin_vertex(&self.skin, &self.bones, vertex) - skin_vertex(&self.skin, &self.rest, vertex)
    }

    /// The vertex farthest in some sense among those of the left flipper's blade beyond a share of its reach.
    fn flipper(&self, beyond: f64, far: impl Fn(DVec3) -> f64) -> usize {
        let of_blade = |v: usize| {
            let heavy = self.skin.weights[v].iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            self.skin.bones[usize::from(heavy.0)].name.starts_with("left_flipper")
        };
        let blade: Vec<usize> = (0..self.skin.vertices.len()).filter(|v| of_blade(*v)).collect();
        let (near, reach) = blade.iter().fold((f64::MAX, f64::MIN), |(l, m), v| {
            (l.min(self.skin.vertices[*v].y), m.max(self.skin.vertices[*v].y))
        });
        let outer =
            blade.into_iter().filter(|v| self.skin.vertices[*v].y > near + beyond * (reach - near));
        outer
            .max_by(|a, b| far(self.skin.vertices[*a]).total_cmp(&far(self.skin.vertices[*b])))
            .unwrap()
    }
}

#[test]
fn the_four_motions_of_the_flippers_and_their_sweep_move_the_skin_as_their_names_say() {
    assert!(Posed::holding("flippers-abduct").tip().z > 0.5, "abduction lifts the tip");
    assert!(Posed::holding("flippers-adduct").tip().z < -0.5, "adduction lowers it");
    let [leading, trailing] = Posed::holding("flippers-pronate").edges();
    assert!(
        leading < -0.05 && trailing > leading + 0.2,
        "pronation turns the leading edge down: {leading} {trailing}"
    );
    let [leading, trailing] = Posed::holding("flippers-supinate").edges();
    assert!(
        leading > 0.05 && trailing < leading - 0.2,
        "supination turns it up: {leading} {trailing}"
    );
    assert!(Posed::holding("flippers-sweep").tip().x > 0.5, "swept forward");
    let tuck = Posed::holding("flippers-tuck").tip();
    assert!(tuck.x < -0.5 && tuck.y < -0.3, "tucked aft along the body: {tuck}");
}
