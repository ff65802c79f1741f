//! A made-up summary of a run in which no two numbers are the same. Tests of the command line and of
//! the window include this file too.

use std::time::Duration;

use endline_sdk::{BodyPart, Region};
use endline_session::plugins::PluginUsed;
use endline_session::report::headline::{Sentence, Tone};
use endline_session::report::needed::NeededStrength;
use endline_session::report::{Report, SettledReport};
use endline_session::timing::Timing;
use endline_sim::balance::BalanceSummary;
use endline_sim::metrics::{
    BeatSummary, BodyOnWhale, BodySummary, Event, EventKind, KineticSummary, LineSummary,
    LinkSummary, MomentumBalance, Outcome, PatchSummary, ProbeSummary, RegionSummary, Summary,
    WhaleSummary,
};
use endline_sim::{Audit, CostPart, DVec3};

/// Numbers that never come twice.
struct Numbers(u64);

impl Numbers {
    fn whole(&mut self) -> u64 {
        self.0 += 1;
        self.0
    }

    fn real(&mut self) -> f64 {
        self.whole() as f64 + 0.25
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.real(), self.real(), self.real())
    }
}

/// A summary with everything that a run may have.
pub fn report() -> Report {
    let next = &mut Numbers(1000);
    Report {
        scenario: "scenarios/made-up.toml".into(),
        seed: next.whole(),
        simulated_s: next.real(),
        timing: timing(next),
        dt_s: next.real(),
        steps: next.whole(),
        nodes: next.whole() as usize,
        triangles: next.whole() as usize,
        state_hash: "0123456789abcdef".into(),
        headline: vec![Sentence { text: "It ended.".into(), tone: Tone::Result }],
        invalid_because: vec!["a reason".into(), "another".into()],
        stopped: Some("it stopped".into()),
        audit: audit(next),
        balance: Some(balance(next)),
        summary: summary(next),
        needed: NeededStrength {
            needed_rope_n: Some(next.real()),
            needed_link_n: Some(next.real()),
            needed_place_n: Some(next.real()),
        },
        settled_tension_n: vec![next.real(), next.real()],
        settled: SettledReport {
            converged: true,
            outcome: "at rest".into(),
            residual_n: next.real(),
        },
        events: vec![event(EventKind::LinkParted, next), event(EventKind::Wrap, next)],
        model_hash: "fedcba9876543210".into(),
        plugins: vec![PluginUsed {
            id: "org.endline.made-up".into(),
            version: "1.2.3".into(),
            file_hash: "00ff".into(),
        }],
    }
}

fn timing(next: &mut Numbers) -> Timing {
    let mut timing = Timing::settled_in(Duration::from_secs_f64(next.real()));
    for phase in [&mut timing.approach, &mut timing.contact] {
        (phase.simulated_s, phase.wall_s) = (next.real(), next.real());
    }
    for part in CostPart::ALL.iter().copied() {
        timing.cost.add_ns(part, next.whole() * 1_000_000_000);
    }
    timing
}

fn audit(next: &mut Numbers) -> Audit {
    Audit {
        tunnelled: next.whole(),
        max_penetration_m: next.real(),
        bodies_crossed: next.whole(),
        ropes_crossed: next.whole(),
        ropes_through: next.whole(),
        rope_within_m: next.real(),
        rope_steps: next.whole(),
        least_distance_m: Some(next.real()),
        non_finite: next.whole(),
        held_steps: next.whole(),
        solver_steps: next.whole(),
        contact_steps: next.whole(),
        halved: next.whole(),
        touching_steps: next.whole(),
        unconverged: next.whole(),
        unconverged_parted: next.whole(),
        spikes: next.whole(),
        passes: next.whole(),
        splits: next.whole(),
        resolution_looks: next.whole(),
        resolution_missed: next.whole(),
        resolution_ratio: next.real(),
        postures_held: next.whole(),
        limited_by: std::array::from_fn(|_| next.whole()),
    }
}

fn balance(next: &mut Numbers) -> BalanceSummary {
    BalanceSummary {
        impulse_ns: std::array::from_fn(|_| next.vector()),
        momentum_ns: next.vector(),
        greatest_ns: next.real(),
        residual_ns: next.real(),
        work_j: std::array::from_fn(|_| next.real()),
        damping_j: next.real(),
        contact_j: next.real(),
        kinetic_j: next.real(),
        elastic_j: next.real(),
        whale_missed_ns: Some(next.real()),
    }
}

fn summary(next: &mut Numbers) -> Summary {
    Summary {
        lines: vec![line("endline-top", next), line("endline-foot", next)],
        links: vec![link("wl-600", next), link("wl-1700", next)],
        bodies: vec![body("trap", next), body("buoy", next)],
        probes: vec![ProbeSummary {
            id: "tow".into(),
            unit: "N",
            last: next.real(),
            min: next.real(),
            max: next.real(),
            mean: next.real(),
        }],
        whale: Some(whale(next)),
    }
}

fn line(id: &str, next: &mut Numbers) -> LineSummary {
    LineSummary {
        id: id.into(),
        peak_tension_n: next.real(),
        peak_at_s: next.real(),
        unconverged_peak_n: next.real(),
        place_peaks_n: [next.real(), next.real(), next.real()],
        bin_peaks_n: vec![next.real(), next.real()],
        end_a_tension_n: next.real(),
        end_b_tension_n: next.real(),
        parted_at_s: Some(next.real()),
        drag_n: next.vector(),
        whale_normal_n: next.real(),
        whale_friction_n: next.real(),
        twist: next.real(),
        peak_twist: next.real(),
    }
}

fn link(id: &str, next: &mut Numbers) -> LinkSummary {
    LinkSummary {
        id: id.into(),
        rating_n: next.real(),
        peak_tension_n: next.real(),
        unconverged_peak_n: next.real(),
        parted_at_s: Some(next.real()),
    }
}

fn body(id: &str, next: &mut Numbers) -> BodySummary {
    BodySummary {
        id: id.into(),
        position_m: next.vector(),
        peak_speed_m_s: next.real(),
        drag_n: next.vector(),
        on_whale: BodyOnWhale {
            whale_part: Some(BodyPart::Head),
            whale_since_s: Some(next.real()),
            whale_contact_time_s: next.real(),
            caught: true,
            was_caught: true,
            peak_whale_push_n: next.real(),
            peak_whale_part: Some(BodyPart::Peduncle),
            whale_friction_work_j: next.real(),
        },
    }
}

fn event(kind: EventKind, next: &mut Numbers) -> Event {
    Event { time_s: next.real(), kind, subject: "left_fluke".into(), value: next.real() }
}

fn whale(next: &mut Numbers) -> WhaleSummary {
    WhaleSummary {
        outcome: Outcome::PartedEntangled,
        decided: true,
        first_contact_s: Some(next.real()),
        last_contact_s: Some(next.real()),
        contact_time_s: next.real(),
        regions: BodyPart::ALL.into_iter().map(|part| region(part, next)).collect(),
        patches: Region::ALL.into_iter().map(|region| patch(region, next)).collect(),
        hooked: true,
        lodged_in_mouth: false,
        was_lodged_in_mouth: true,
        was_body_caught: true,
        peak_body_push_n: next.real(),
        drag_added_n: next.real(),
        drag_added_now_n: next.real(),
        trailing_m: next.real(),
        tethered_m: next.real(),
        speed_made_good_m_s: next.real(),
        unchanged_s: next.real(),
        carried: vec!["trap".into(), "buoy".into()],
        carried_traps: next.whole(),
        carried_buoys: next.whole(),
        beat: Some(BeatSummary {
            beats: next.whole() as u32,
            frequency_hz: next.real(),
            excursion_m: next.real(),
            speed_m_s: next.real(),
            strouhal: Some(next.real()),
        }),
        kinetic: Some(KineticSummary {
            thrust_n: next.real(),
            power_w: next.real(),
            body_drag_n: next.real(),
            speed_m_s: next.real(),
            speed_lost_m_s: next.real(),
            peak_thrust_n: next.real(),
            peak_rope_pull_n: next.real(),
            velocity_m_s: next.vector(),
            momentum_ns: next.vector(),
            balance: MomentumBalance {
                momentum_change_ns: next.real(),
                thrust_impulse_ns: next.real(),
                drag_impulse_ns: next.real(),
                gear_impulse_ns: next.real(),
                kinetic_j: next.real(),
                thrust_work_j: next.real(),
                drag_work_j: next.real(),
                gear_work_j: next.real(),
            },
        }),
        winding_jumps: next.whole(),
        beyond_rope_share: next.real(),
    }
}

fn region(part: BodyPart, next: &mut Numbers) -> RegionSummary {
    RegionSummary {
        part,
        touching: true,
        wraps: next.real(),
        peak_wraps: next.real(),
        touching_wraps: next.real(),
        peak_touching_wraps: next.real(),
        across: usize::try_from(next.whole()).unwrap_or_default(),
        contact_length_m: next.real(),
        peak_contact_length_m: next.real(),
        peak_normal_n: next.real(),
        peak_pressure_pa: next.real(),
        friction_work_j: next.real(),
    }
}

fn patch(region: Region, next: &mut Numbers) -> PatchSummary {
    PatchSummary {
        region,
        contact_length_m: next.real(),
        normal_n: next.real(),
        friction_n: next.real(),
        force_n: next.vector(),
        tension_n: next.real(),
        peak_contact_length_m: next.real(),
        peak_normal_n: next.real(),
        peak_friction_n: next.real(),
        peak_tension_n: next.real(),
        peak_line_load_n_m: next.real(),
        peak_pressure_pa: next.real(),
        friction_work_j: next.real(),
    }
}
