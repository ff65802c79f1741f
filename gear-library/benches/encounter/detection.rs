//! Cost of contact detection in a step: the search of the tree, distances of near pairs, and sweeps, repeated and timed.

use cpu_time::ThreadTime;
use endline_sim::geometry::distance::segment_triangle;
use endline_sim::geometry::sweep::{SweptSegment, safe_fraction};
use endline_sim::whale::{Candidate, Surface, pose};
use endline_sim::{DAffine3, Model, State};

/// Rope within this distance of skin is tested, as in a step [m].
const MARGIN_M: f64 = 0.08;
/// Smallest separation of the sweeps [m].
const SEPARATION_M: f64 = 0.000_5;

/// Detection over a section of a run.
pub struct Detection {
    surface: Option<Surface>,
    bones: [Vec<DAffine3>; 2],
    found: Vec<Candidate>,
    segments: Vec<SweptSegment>,
    /// CPU time of all steps measured [s].
    pub seconds: f64,
    /// Number of all pairs of segment and triangle.
    pub pairs: u64,
    /// Steps measured.
    pub steps: u64,
}

impl Detection {
    /// Scratch for a model.
    pub fn of(model: &Model) -> Self {
        let surface = model.skin_tree.clone().map(Surface::new);
        Self {
            surface,
            bones: [Vec::new(), Vec::new()],
            found: Vec::new(),
            segments: Vec::new(),
            seconds: 0.0,
            pairs: 0,
            steps: 0,
        }
    }

    /// Finds contacts of one solver step from the earlier place of the whale to the present one.
    pub fn measure(&mut self, model: &Model, earlier: &State, now: &State) {
        let (Some(surface), Some(whale)) = (&mut self.surface, &model.spec.whale) else { return };
        for (bones, state) in self.bones.iter_mut().zip([earlier, now]) {
            let Some(at) = &state.whale else { return };
            pose(&whale.skin, at.position, at.orientation, &at.posture, bones);
        }
        let nodes =
            (0..model.spec.lines.len()).flat_map(|line| model.line_nodes[line].clone().skip(1));
        self.segments.clear();
        self.segments.extend(nodes.map(|node| SweptSegment {
            a0: earlier.rope.position[node - 1],
            b0: earlier.rope.position[node],
            a1: now.rope.position[node - 1],
            b1: now.rope.position[node],
        }));
        let start = ThreadTime::now();
        let [from, to] = &self.bones;
        surface.begin(from, to);
        surface.gather(&self.segments, MARGIN_M, &mut self.found);
        let mut least = f64::INFINITY;
        for pair in &self.found {
            let (segment, triangle) =
                (&self.segments[pair.segment as usize], surface.triangle_sweep(pair.triangle));
            least = least
                .min(segment_triangle(segment.at(0.0), triangle[0]).distance)
                .min(safe_fraction(segment, &triangle, SEPARATION_M));
        }
        divan::black_box(least);
        self.seconds += start.elapsed().as_secs_f64();
        self.pairs += self.found.len() as u64;
        self.steps += 1;
    }
}
