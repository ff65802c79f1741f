//! Impossible output of a friction law, a whale or a gear ends the call with the plugin's name.

use std::sync::Arc;

use endline_fixtures::hooks::{Motion, descriptor};
use endline_sdk::{
    AttributeValue, BodyKind, BodyPart, Contacts, Descriptor, FrictionModel, FrictionResponse,
    GearAction, GearStep, GearType, HookError, LineEnd, MotionOutput, Rig, RigBody, RigEnd,
    RigJoint, RigLine, RigLink, Site,
};
use endline_session::plugins::{Hook, PluginHost};

use crate::refused::{ONE_CONTACT, motion_input};

const ID: &str = "org.example.bad";

/// A descriptor with this many numbers of state.
fn with_state(state_len: usize) -> Descriptor {
    Descriptor { state_len, ..descriptor(ID) }
}

/// A plugin with constant output.
struct Gives<T>(Descriptor, T);

impl FrictionModel for Gives<FrictionResponse> {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn respond(
        &self,
        _: &[f64],
        _: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        out.fill(self.1);
        Ok(())
    }

    fn advance(&self, _: &[f64], _: &Contacts<'_>, out: &mut [f64]) -> Result<(), HookError> {
        out.fill(f64::INFINITY);
        Ok(())
    }
}

impl GearType for Gives<Rig> {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn build(&self, _: &[AttributeValue], _: &Site) -> Result<Rig, HookError> {
        Ok(self.1.clone())
    }

    fn step(
        &self,
        _: &[AttributeValue],
        _: &GearStep<'_>,
        _: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        actions.push(GearAction::CutLine { line: 1, end: LineEnd::A });
        Ok(())
    }
}

fn host(hook: Hook) -> PluginHost {
    let mut host = PluginHost::empty();
    host.add(hook).unwrap();
    host
}

fn expect(error: &HookError, reason: &str) {
    assert!(
        error.message.starts_with(&format!("plugin `{ID}`: ")) && error.message.contains(reason),
        "{error}"
    );
}

fn friction(force_n: [f64; 3]) -> Arc<dyn FrictionModel> {
    let response = FrictionResponse { force_n, ..FrictionResponse::default() };
    host(Hook::Friction(Arc::new(Gives(with_state(0), response)))).friction(ID).unwrap()
}

#[test]
fn friction_that_cannot_be_is_refused() {
    let respond =
        |force_n| friction(force_n).respond(&[], &ONE_CONTACT, &mut [FrictionResponse::default()]);
    respond([-30.0, 0.0, 0.0]).unwrap();
    expect(&respond([f64::NAN, 0.0, 0.0]).unwrap_err(), "it gave NaN for the force");
    expect(&respond([30.0, 0.0, 0.0]).unwrap_err(), "friction may not create energy");
    expect(&respond([0.0, 0.0, -5.0]).unwrap_err(), "does not lie across the normal");
    expect(
        &respond([-301.0, 0.0, 0.0]).unwrap_err(),
        "beyond 10 times coefficient times normal force",
    );
    let too_few = friction([0.0; 3]).respond(&[], &ONE_CONTACT, &mut []);
    expect(&too_few.unwrap_err(), "expected 1 places for answers, got 0");
    let hook = Hook::Friction(Arc::new(Gives(with_state(1), FrictionResponse::default())));
    let advanced = host(hook).friction(ID).unwrap().advance(
        &[],
        &Contacts { state: &[0.0], ..ONE_CONTACT },
        &mut [0.0],
    );
    expect(&advanced.unwrap_err(), "it gave inf for a float of its state");
}

#[test]
fn a_whale_that_cannot_be_is_refused() {
    let forces = [0.0; BodyPart::ALL.len()];
    let step = |change: fn(&mut MotionOutput)| {
        let mut out = MotionOutput::default();
        change(&mut out);
        let motion =
            host(Hook::Motion(Motion::new(with_state(0), move |_| out))).motion(ID).unwrap();
        motion.step(&[], &motion_input(&forces), &mut [])
    };
    step(|_| ()).unwrap();
    expect(&step(|out| out.speed_m_s = f64::NAN).unwrap_err(), "it gave NaN for the speed");
    expect(&step(|out| out.speed_m_s = 31.0).unwrap_err(), "31 m/s for the speed");
    expect(&step(|out| out.turn_rate_rad_s[1] = f64::INFINITY).unwrap_err(), "a turn rate");
    expect(&step(|out| out.posture.spine_yaw[7] = 4.0).unwrap_err(), "4 rad for spine_yaw");
    expect(&step(|out| out.posture.jaw = f64::NAN).unwrap_err(), "NaN for jaw");
}

fn rig() -> Rig {
    let position_m = [0.0, 0.0, -10.0];
    Rig {
        bodies: vec![RigBody {
            id: "trap".into(),
            kind: BodyKind::Trap,
            item: "wire".into(),
            position_m,
        }],
        joints: vec![RigJoint { id: "top".into(), position_m: [0.0; 3] }],
        lines: vec![RigLine {
            id: "endline".into(),
            rope: "sink".into(),
            from: RigEnd::Body("trap".into()),
            to: RigEnd::Joint("top".into()),
            length_m: 12.0,
            laid_m: Vec::new(),
        }],
        links: vec![RigLink {
            id: "link".into(),
            item: "wl".into(),
            line: "endline".into(),
            end: LineEnd::B,
        }],
    }
}

#[test]
fn a_rig_that_does_not_fit_together_is_refused() {
    let build = |change: fn(&mut Rig)| {
        let mut rig = rig();
        change(&mut rig);
        let gear = host(Hook::Gear(Arc::new(Gives(with_state(0), rig)))).gear(ID).unwrap();
        gear.build(&[], &Site { depth_m: 10.0, current_m_s: [0.0; 2] })
    };
    assert_eq!(build(|_| ()).unwrap(), rig());
    build(|rig| rig.lines[0].from = RigEnd::Body("trap:bridle-port".into())).unwrap();
    expect(
        &build(|rig| rig.lines[0].from = RigEnd::Body("buoy:side".into())).unwrap_err(),
        "ends at body `buoy`, which its rig lacks",
    );
    expect(
        &build(|rig| rig.lines[0].to = RigEnd::Joint("buoy".into())).unwrap_err(),
        "ends at joint `buoy`, which its rig lacks",
    );
    expect(&build(|rig| rig.lines[0].length_m = -1.0).unwrap_err(), "line `endline` is -1 m long");
    expect(
        &build(|rig| rig.lines[0].laid_m = vec![[0.0; 3]]).unwrap_err(),
        "line `endline` is laid through one place",
    );
    expect(
        &build(|rig| rig.lines[0].laid_m = vec![[f64::INFINITY; 3]; 2]).unwrap_err(),
        "inf for a place",
    );
    expect(&build(|rig| rig.lines[0].rope.clear()).unwrap_err(), "names no rope");
    expect(&build(|rig| rig.links[0].line = "other".into()).unwrap_err(), "link `link`");
    expect(&build(|rig| rig.bodies[0].position_m[2] = f64::NAN).unwrap_err(), "NaN for a place");
    expect(
        &build(|rig| rig.bodies.push(rig.bodies[0].clone())).unwrap_err(),
        "body id `trap` is empty or used twice",
    );
}

#[test]
fn an_action_on_a_line_it_lacks_is_refused() {
    let gear = host(Hook::Gear(Arc::new(Gives(with_state(0), rig())))).gear(ID).unwrap();
    let step = |end_tension_n: &[[f64; 2]]| {
        gear.step(
            &[],
            &GearStep { time_s: 0.0, dt_s: 0.01, end_tension_n },
            &mut [],
            &mut Vec::new(),
        )
    };
    step(&[[0.0; 2]; 2]).unwrap();
    expect(&step(&[[0.0; 2]]).unwrap_err(), "it cuts line 1, but its rig has 1 lines");
}

#[test]
fn the_same_id_twice_and_an_unsound_id_are_refused() {
    let hook = || Hook::Gear(Arc::new(Gives(with_state(0), rig())));
    let mut host = host(hook());
    assert!(host.add(hook()).unwrap_err().reason.contains("already has a plugin with this id"));
    for id in ["", "bad", "org..bad", "org.exa mple"] {
        let descriptor = Descriptor { id: id.into(), ..with_state(0) };
        let problem = host.add(Hook::Gear(Arc::new(Gives(descriptor, rig())))).unwrap_err();
        assert!(problem.reason.contains("not a reverse-domain name"), "{problem}");
    }
}
