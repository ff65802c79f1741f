//! Particles that drift with the water in films.

use glam::Vec3;
use three_d::{
    Blend, Context, CoreError, Cull, DepthTest, ElementBuffer, Program, RenderStates,
    Vec3 as GlVec3, VertexBuffer, WriteMask,
};

use super::draw::Uniforms;
use super::shaders;

/// The particles on the graphics card.
pub(super) struct Snow {
    program: Program,
    seed: VertexBuffer<[f32; 3]>,
    corner: VertexBuffer<[f32; 3]>,
    triangles: ElementBuffer<u32>,
}

/// Number of particles in the cell of 8 m that repeats around the eye.
const PARTICLES: u32 = 9000;

impl Snow {
    /// Errors: shaders that this OpenGL refuses.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let program = shaders::of_snow(context)?;
        // The additive recurrence of the plastic number spreads points evenly without a lattice that the eye would see
        // (Roberts 2018).
        const STEPS: [f64; 3] =
            [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];
        let place = |index: u32| STEPS.map(|step| (0.5 + step * f64::from(index)).fract() as f32);
        let radius_m =
            |index: u32| 0.0012 + 0.0022 * ((f64::from(index) * 0.618_034).fract() as f32).powi(3);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let all = 0..PARTICLES;
        let seeds: Vec<_> = all.clone().flat_map(|index| [place(index); 4]).collect();
        let squares: Vec<_> =
            all.clone().flat_map(|index| corners.map(|[x, y]| [x, y, radius_m(index)])).collect();
        let triangles: Vec<_> =
            all.flat_map(|index| [0, 1, 2, 0, 2, 3].map(|corner| 4 * index + corner)).collect();
        Ok(Self {
            program,
            seed: VertexBuffer::new_with_data(context, &seeds),
            corner: VertexBuffer::new_with_data(context, &squares),
            triangles: ElementBuffer::new_with_data(context, &triangles),
        })
    }

    /// Draws the particles in water that has drifted by `drift_m`.
    pub fn draw(&self, eye: &Uniforms, drift_m: Vec3) {
        let program = &self.program;
        eye.set_sea(program);
        program.use_uniform("to_clip", eye.to_clip);
        program.use_uniform("pixel_angle", eye.pixel_angle);
        program.use_uniform("drift_m", GlVec3::new(drift_m.x, drift_m.y, drift_m.z));
        for (name, sight) in ["right", "up"].into_iter().zip(eye.sight) {
            let length = sight.x.hypot(sight.y).hypot(sight.z);
            program.use_uniform(name, sight * (1.0 / length.max(1e-9)));
        }
        program.use_vertex_attribute("seed", &self.seed);
        program.use_vertex_attribute("corner", &self.corner);
        let states = RenderStates {
            depth_test: DepthTest::LessOrEqual,
            cull: Cull::None,
            blend: Blend::TRANSPARENCY,
            write_mask: WriteMask::COLOR,
        };
        program.draw_elements(states, eye.viewport, &self.triangles);
    }
}
