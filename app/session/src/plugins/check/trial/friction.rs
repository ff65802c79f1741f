//! A friction model, tried out.

use endline_sdk::{Contacts, FrictionModel, FrictionResponse, HookError, Region};

use super::{
    Play, Random, Trial, across, bits, defaults, dot, drawn, numbers, on_threads, plays_again,
};

/// Sets of attributes, steps with each, and contacts in a call.
const SETS: u64 = 40;
const STEPS: usize = 40;
const CONTACTS: usize = 8;
/// Share of the energy exchanged that rounding may give.
const ROUNDING: f64 = 1e-9;

pub(super) fn run(friction: &dyn FrictionModel, trial: &mut Trial<'_>) {
    if !trial
        .check("defaults", || once(friction).map(|()| String::new()).map_err(|error| error.message))
    {
        return;
    }
    let mut first = None;
    let tried = trial.check("ranges", || {
        for set in 0..SETS {
            let play = play(friction, set, None, 1).map_err(|error| error.message)?;
            first.get_or_insert(play);
        }
        Ok(format!(
            "{} contacts at attributes drawn within their ranges",
            SETS as usize * STEPS * CONTACTS
        ))
    });
    let (true, Some(first)) = (tried, first) else { return };
    plays_again(trial, &first, |restored| play(friction, 0, restored, 1));
    trial.check("pure", || pure(friction, &first));
    trial.check("energy", || energy(friction));
    trial.check("threads", || on_threads(&first, || play(friction, 0, None, 1)));
    trial.time("a contact and step", CONTACTS * STEPS, || play(friction, 0, None, 1).map(drop));
}

/// Three contacts: one that hardly presses, one that sticks, one that slips.
fn once(friction: &dyn FrictionModel) -> Result<(), HookError> {
    let attributes = numbers(&defaults(&friction.descriptor().attributes));
    let mut floats = vec![0.0; 3 * friction.descriptor().state_len];
    let contacts = Contacts {
        dt_s: 0.002,
        normal_force_n: &[0.0, 10.0, 100.0],
        normal: &[[0.0, 0.0, 1.0]; 3],
        grain: &[[0.0, 1.0, 0.0]; 3],
        along: &[[1.0, 0.0, 0.0]; 3],
        slip_m: &[[0.0; 3], [1e-6, 0.0, 0.0], [0.0, 0.01, 0.0]],
        length_m: &[0.02; 3],
        coefficient: &[0.3; 3],
        region: &[Region::Body as u32; 3],
        rope: &[0; 3],
        state: &floats.clone(),
    };
    friction.respond(&attributes, &contacts, &mut [FrictionResponse::default(); 3])?;
    friction.advance(&attributes, &contacts, &mut floats)
}

/// One set of attributes and its steps, `asked` times each; from floats saved half way where some are given.
fn play(
    friction: &dyn FrictionModel,
    set: u64,
    restored: Option<&[f64]>,
    asked: usize,
) -> Result<Play, HookError> {
    let mut random = Random(set);
    let attributes = numbers(&drawn(&friction.descriptor().attributes, &mut random));
    let draws: Vec<_> = (0..STEPS).map(|_| Draw::new(&mut random)).collect();
    let floats = CONTACTS * friction.descriptor().state_len;
    Play::of(&draws, floats, restored, |step, draw, state| {
        for extra in 1..asked {
            // Other slips, as a solver tries them on its way to a balance.
            let other = &draws[(step + extra) % STEPS];
            friction.respond(
                &attributes,
                &Contacts { slip_m: &other.slip_m, ..draw.contacts(state) },
                &mut [FrictionResponse::default(); CONTACTS],
            )?;
        }
        let (out, ends) = ask_watched(friction, &attributes, &draw.contacts(state))?;
        *state = ends;
        let of = |a: &FrictionResponse| {
            a.force_n.into_iter().chain(a.by_slip.into_iter().flatten()).chain(a.by_normal_force)
        };
        Ok(bits(out.iter().flat_map(of).chain(state.iter().copied())).collect())
    })
}

/// Answers and floats at the end of a step, with more room behind them than the plugin may use: the plugin must not change it.
fn ask_watched(
    friction: &dyn FrictionModel,
    attributes: &[f64],
    contacts: &Contacts<'_>,
) -> Result<(Vec<FrictionResponse>, Vec<f64>), HookError> {
    let (answers, floats) = (contacts.len(), contacts.state.len());
    let mut out = vec![FrictionResponse::default(); 2 * answers];
    let mut ends = vec![0.0; floats + 64];
    friction.respond(attributes, contacts, &mut out[..answers])?;
    friction.advance(attributes, contacts, &mut ends[..floats])?;
    if out[answers..].iter().any(|beyond| *beyond != FrictionResponse::default())
        || ends[floats..].iter().any(|beyond| *beyond != 0.0)
    {
        return Err(HookError::new(format!(
            "it wrote beyond the {answers} answers and {floats} floats that it has room for"
        )));
    }
    out.truncate(answers);
    ends.truncate(floats);
    Ok((out, ends))
}

/// Asked four times a step instead of once, it answers and ends with the same bits.
fn pure(friction: &dyn FrictionModel, first: &Play) -> Result<String, String> {
    let often = play(friction, 0, None, 4).map_err(|error| error.message)?;
    match super::first_difference(&first.answers, &often.answers) {
        None => Ok("asked once or four times a step, the same bits".to_owned()),
        Some(step) => Err(format!(
            "`respond` is not pure: asked four times in a step instead of once, step {step} gave other bits"
        )),
    }
}

/// From first touch on, the work on the rope is never above zero: each contact alone, over random paths.
fn energy(friction: &dyn FrictionModel) -> Result<String, String> {
    for set in 0..SETS {
        let mut random = Random(1000 + set);
        let attributes = numbers(&drawn(&friction.descriptor().attributes, &mut random));
        let way = random.order(-6.0, -2.0);
        let frame = Draw::new(&mut random);
        let mut state = vec![0.0; CONTACTS * friction.descriptor().state_len];
        let (mut work, mut exchanged) = ([0.0; CONTACTS], [0.0; CONTACTS]);
        for _ in 0..2 * STEPS {
            let slip_m: [[f64; 3]; CONTACTS] =
                std::array::from_fn(|i| across(frame.normal[i], random.vector(way)));
            let normal_force_n: [f64; CONTACTS] =
                std::array::from_fn(|_| random.between(-50.0, 300.0).max(0.0));
            let contacts = Contacts {
                slip_m: &slip_m,
                normal_force_n: &normal_force_n,
                ..frame.contacts(&state)
            };
            let mut out = [FrictionResponse::default(); CONTACTS];
            friction.respond(&attributes, &contacts, &mut out).map_err(|error| error.message)?;
            let mut ends = vec![0.0; state.len()];
            friction.advance(&attributes, &contacts, &mut ends).map_err(|error| error.message)?;
            state = ends;
            for i in 0..CONTACTS {
                let step = dot(out[i].force_n, slip_m[i]);
                work[i] += step;
                exchanged[i] += step.abs();
                if work[i] > ROUNDING * exchanged[i] {
                    return Err(format!(
                        "it adds energy: {:.3e} J more than went in, at attributes {attributes:?}",
                        work[i]
                    ));
                }
            }
        }
    }
    Ok(format!("none beyond what went in, over {} paths", SETS as usize * CONTACTS))
}

/// Contacts drawn at random.
struct Draw {
    dt_s: f64,
    normal_force_n: [f64; CONTACTS],
    normal: [[f64; 3]; CONTACTS],
    grain: [[f64; 3]; CONTACTS],
    along: [[f64; 3]; CONTACTS],
    slip_m: [[f64; 3]; CONTACTS],
    length_m: [f64; CONTACTS],
    coefficient: [f64; CONTACTS],
    region: [u32; CONTACTS],
}

impl Draw {
    fn new(random: &mut Random) -> Self {
        let normal: [[f64; 3]; CONTACTS] = std::array::from_fn(|_| random.direction());
        let way = random.order(-7.0, -2.0);
        Self {
            dt_s: random.order(-4.0, -2.0),
            normal_force_n: std::array::from_fn(|_| random.between(-50.0, 500.0).max(0.0)),
            grain: normal.map(|normal| random.tangent(normal)),
            along: normal.map(|normal| random.tangent(normal)),
            slip_m: normal.map(|normal| across(normal, random.vector(way))),
            length_m: std::array::from_fn(|_| random.between(1e-3, 0.03)),
            coefficient: std::array::from_fn(|_| random.between(0.0, 1.0)),
            region: std::array::from_fn(|_| Region::ALL[random.below(Region::ALL.len())] as u32),
            normal,
        }
    }

    fn contacts<'a>(&'a self, state: &'a [f64]) -> Contacts<'a> {
        Contacts {
            dt_s: self.dt_s,
            normal_force_n: &self.normal_force_n,
            normal: &self.normal,
            grain: &self.grain,
            along: &self.along,
            slip_m: &self.slip_m,
            length_m: &self.length_m,
            coefficient: &self.coefficient,
            region: &self.region,
            rope: &[0; CONTACTS],
            state,
        }
    }
}
