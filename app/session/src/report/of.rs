//! From a run to its summary.

use endline_sim::Audit;
use endline_sim::metrics::{
    BeatSummary, BodySummary, Event, KineticSummary, LineSummary, LinkSummary, PatchSummary,
    ProbeSummary, RegionSummary, Summary, WhaleSummary,
};
use endline_sim::state::LimitedBy;

use super::*;
use crate::error::Error;
use crate::run::{Run, by_line};
use crate::timing::Phase;

impl Report {
    /// The summary of a run as it stands.
    #[must_use]
    pub fn of(run: &Run) -> Self {
        let model = run.model();
        let settings = &model.spec.settings;
        let (audit, whole) = (run.audit(), run.timing().whole());
        let Summary { lines: _, links, bodies, probes, whale } = run.summary();
        let stopped = run.stopped().map(|stop| Error::Stopped(stop.clone()).to_string());
        let invalid_because = validity::reasons(stopped.as_deref(), &audit);
        Self {
            schema: SCHEMA,
            scenario: run.prepared().source.scenario_name.clone(),
            seed: settings.seed,
            simulated_s: run.state().time_s,
            wall_s: whole.wall_s,
            times_real_time: whole.times_real_time(),
            dt_s: settings.step_s,
            steps: run.state().step,
            nodes: model.node_count,
            triangles: model.spec.whale.as_ref().map_or(0, |whale| whale.skin.triangles.len()),
            state_hash: run.state_hash().hex(),
            valid: invalid_because.is_empty(),
            invalid_because,
            stopped,
            audit: audit_report(&audit, whale.as_ref().map_or(0, |whale| whale.winding_jumps)),
            lines: line_reports(run),
            links: links.into_iter().map(LinkReport::from).collect(),
            bodies: bodies.into_iter().map(BodyReport::from).collect(),
            probes: probes.into_iter().map(ProbeReport::from).collect(),
            whale: whale.map(whale_report),
            approach: phase_report(&run.timing().approach),
            contact: phase_report(&run.timing().contact),
            settled: settled_report(run),
            events: event_reports(run),
            version: crate::VERSION,
            model_hash: run.prepared().source.hash(),
            plugins: run.prepared().plugins.clone(),
        }
    }
}

fn settled_report(run: &Run) -> SettledReport {
    let settled = run.settled();
    SettledReport {
        settled: settled.converged,
        outcome: settled.outcome.to_string(),
        residual_N: settled.residual_n,
        wall_s: run.timing().settle_wall_s,
    }
}

fn audit_report(audit: &Audit, winding_jumps: u64) -> AuditReport {
    let Audit {
        tunnelled,
        max_penetration_m,
        ropes_crossed,
        ropes_through,
        rope_steps,
        least_distance_m,
        non_finite,
        solver_steps,
        contact_steps,
        halved,
        unconverged,
        passes,
        splits,
        postures_held,
        limited_by,
    } = *audit;
    let steps_limited_by =
        LimitedBy::ALL.iter().zip(limited_by).map(|(limit, steps)| (limit.name(), steps)).collect();
    let (limit, steps) = LimitedBy::mostly(&limited_by);
    let steps_mostly_limited_by =
        format!("{} ({:.0} %)", limit.words(), 100.0 * steps as f64 / solver_steps.max(1) as f64);
    AuditReport {
        tunnelled,
        max_penetration_m,
        ropes_crossed,
        ropes_through,
        rope_steps,
        least_distance_m,
        winding_jumps,
        non_finite,
        solver_steps,
        contact_steps,
        halved,
        unconverged,
        passes,
        splits,
        postures_held,
        steps_limited_by,
        steps_mostly_limited_by,
    }
}

fn line_reports(run: &Run) -> Vec<LineReport> {
    let report = |(line, settled): (LineSummary, &f64)| LineReport {
        id: line.id,
        peak_tension_N: line.peak_tension_n,
        peak_at_s: line.peak_at_s,
        end_a_tension_N: line.end_a_tension_n,
        end_b_tension_N: line.end_b_tension_n,
        settled_tension_N: *settled,
        parted_at_s: line.parted_at_s,
        drag_N: line.drag_n.to_array(),
        whale_normal_N: line.whale_normal_n,
        whale_friction_N: line.whale_friction_n,
    };
    let settled = by_line(run.model(), &run.settled().state.rope.tension);
    run.summary().lines.into_iter().zip(&settled).map(report).collect()
}

impl From<LinkSummary> for LinkReport {
    fn from(link: LinkSummary) -> Self {
        Self {
            id: link.id,
            rating_N: link.rating_n,
            peak_tension_N: link.peak_tension_n,
            parted_at_s: link.parted_at_s,
        }
    }
}

impl From<BodySummary> for BodyReport {
    fn from(body: BodySummary) -> Self {
        Self {
            id: body.id,
            position_m: body.position_m.to_array(),
            peak_speed_m_s: body.peak_speed_m_s,
            drag_N: body.drag_n.to_array(),
        }
    }
}

impl From<ProbeSummary> for ProbeReport {
    fn from(probe: ProbeSummary) -> Self {
        Self {
            id: probe.id,
            unit: probe.unit,
            last: probe.last,
            min: probe.min,
            max: probe.max,
            mean: probe.mean,
        }
    }
}

impl From<KineticSummary> for KineticReport {
    fn from(of: KineticSummary) -> Self {
        Self {
            thrust_N: of.thrust_n,
            power_W: of.power_w,
            body_drag_N: of.body_drag_n,
            speed_m_s: of.speed_m_s,
            speed_lost_m_s: of.speed_lost_m_s,
            peak_thrust_N: of.peak_thrust_n,
            peak_rope_pull_N: of.peak_rope_pull_n,
        }
    }
}

fn whale_report(whale: WhaleSummary) -> WhaleReport {
    WhaleReport {
        outcome: whale.outcome.name(),
        decided: whale.decided,
        first_contact_s: whale.first_contact_s,
        last_contact_s: whale.last_contact_s,
        contact_time_s: whale.contact_time_s,
        regions: whale.regions.into_iter().map(RegionReport::from).collect(),
        patches: whale.patches.into_iter().map(PatchReport::from).collect(),
        hooked: whale.hooked,
        lodged_in_mouth: whale.lodged_in_mouth,
        was_lodged_in_mouth: whale.was_lodged_in_mouth,
        drag_added_N: whale.drag_added_n,
        trailing_m: whale.trailing_m,
        tethered_m: whale.tethered_m,
        carried: whale.carried,
        kinetic: whale.kinetic.map(KineticReport::from),
        beat: whale.beat.map(beat_report),
    }
}

fn beat_report(beat: BeatSummary) -> BeatReport {
    BeatReport {
        beats: beat.beats,
        frequency_Hz: beat.frequency_hz,
        excursion_m: beat.excursion_m,
        speed_m_s: beat.speed_m_s,
        strouhal: beat.strouhal,
    }
}

impl From<RegionSummary> for RegionReport {
    fn from(region: RegionSummary) -> Self {
        Self {
            region: region.part.name(),
            wraps: region.wraps,
            peak_wraps: region.peak_wraps,
            touching_wraps: region.touching_wraps,
            peak_touching_wraps: region.peak_touching_wraps,
            contact_length_m: region.contact_length_m,
            peak_contact_length_m: region.peak_contact_length_m,
            peak_normal_N: region.peak_normal_n,
            peak_pressure_Pa: region.peak_pressure_pa,
            friction_work_J: region.friction_work_j,
        }
    }
}

impl From<PatchSummary> for PatchReport {
    fn from(patch: PatchSummary) -> Self {
        Self {
            patch: patch.region.name(),
            contact_length_m: patch.contact_length_m,
            normal_N: patch.normal_n,
            friction_N: patch.friction_n,
            force_N: patch.force_n.to_array(),
            tension_N: patch.tension_n,
            peak_contact_length_m: patch.peak_contact_length_m,
            peak_normal_N: patch.peak_normal_n,
            peak_friction_N: patch.peak_friction_n,
            peak_tension_N: patch.peak_tension_n,
            peak_line_load_N_m: patch.peak_line_load_n_m,
            peak_pressure_Pa: patch.peak_pressure_pa,
            friction_work_J: patch.friction_work_j,
        }
    }
}

fn phase_report(phase: &Phase) -> PhaseReport {
    PhaseReport {
        simulated_s: phase.simulated_s,
        wall_s: phase.wall_s,
        times_real_time: phase.times_real_time(),
    }
}

fn event_reports(run: &Run) -> Vec<EventReport> {
    let report = |event: &Event| EventReport {
        time_s: event.time_s,
        kind: event.kind.name(),
        subject: event.subject.clone(),
        value: event.value,
        unit: event.kind.unit(),
    };
    run.metrics().events().iter().map(report).collect()
}
