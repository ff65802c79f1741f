//! Runs and counts encounters.

use endline_sim::geometry::crossing::pierces;
use endline_sim::whale::{pose, skin_all};
use endline_sim::{Input, Model, State, Workspace, step};

use super::Encounter;

/// Counts of encounters.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub encounters: u64,
    /// With a force on rope.
    pub met: u64,
    /// With rope across skin, by the exact test of the paths or at the end of a step.
    pub crossed: u64,
    /// With rope across rope, by the exact test of the paths.
    pub ropes_crossed: u64,
    /// With forces of skin and rope on rope at once.
    pub met_both: u64,
    /// Ended for another reason.
    pub ended: u64,
    /// With steps in which the rope was held.
    pub held: u64,
    pub solver_steps: u64,
    pub passes: u64,
    pub unconverged: u64,
    /// Numbers of the first that crossed or ended, with the message.
    pub reported: Vec<String>,
}

impl Tally {
    /// The sum of two counts.
    pub fn with(mut self, other: Self) -> Self {
        self.encounters += other.encounters;
        self.met += other.met;
        self.crossed += other.crossed;
        self.ropes_crossed += other.ropes_crossed;
        self.met_both += other.met_both;
        self.ended += other.ended;
        self.held += other.held;
        self.solver_steps += other.solver_steps;
        self.passes += other.passes;
        self.unconverged += other.unconverged;
        self.reported.extend(other.reported);
        self
    }

    /// Runs an encounter and counts it.
    pub fn add(&mut self, number: u64, encounter: Encounter) {
        let Encounter { speed_m_s, pull_n, steps, spec } = encounter;
        let model = Model::new(spec).expect("a sound model");
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        let (mut met, mut met_both, mut crossed, mut ended) = (false, false, false, None);
        let mut ropes_crossed = false;
        while state.step < steps && !crossed && !ropes_crossed && ended.is_none() {
            ended = step(&model, &Input::default(), &mut state, &mut workspace).err();
            met |= workspace.audit.least_distance_m.is_some();
            met_both |= is_between(&workspace);
            ropes_crossed = workspace.audit.ropes_crossed > 0;
            crossed = workspace.audit.tunnelled > 0 || is_pierced(&model, &state);
        }
        self.encounters += 1;
        self.met += u64::from(met);
        self.crossed += u64::from(crossed);
        self.ropes_crossed += u64::from(ropes_crossed);
        self.met_both += u64::from(met_both);
        self.ended += u64::from(ended.is_some() && !crossed);
        self.held += u64::from(workspace.audit.held_steps > 0);
        self.solver_steps += workspace.audit.solver_steps;
        self.passes += workspace.audit.passes;
        self.unconverged += workspace.audit.unconverged;
        if (crossed || ropes_crossed || ended.is_some()) && self.reported.len() < 10 {
            self.reported.push(format!("encounter {number}, {speed_m_s:.1} m/s, {pull_n:.0} N: crossed {crossed}, rope {ropes_crossed}, {ended:?}"));
        }
    }
}

/// Whether rope is pressed on by skin and by rope.
fn is_between(workspace: &Workspace) -> bool {
    let pressed = workspace.contacts.iter().any(|contact| contact.normal_force_n > 0.0);
    pressed && workspace.rope_touches.iter().any(|touch| touch.normal_force_n > 0.0)
}

/// Whether any segment passes through any triangle at their present places.
pub fn is_pierced(model: &Model, state: &State) -> bool {
    let (Some(whale), Some(now)) = (&model.spec.whale, &state.whale) else { return false };
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, now.position, now.orientation, &now.posture, &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let skin =
        || whale.skin.triangles.iter().map(|corners| corners.map(|corner| places[corner as usize]));
    let lines = model.line_nodes.iter().map(|nodes| &state.rope.position[nodes.clone()]);
    lines
        .flat_map(|nodes| nodes.windows(2))
        .any(|ends| skin().any(|triangle| pierces([ends[0], ends[1]], triangle)))
}
