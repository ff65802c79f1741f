//! The eye: an orbit about a target, the named views, and following the whale.

use endline_sim::frame::WhaleFrame;
use glam::{DMat4, DVec2, DVec3, DVec4};

use super::bounds::Bounds;

/// Named views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// From the side and a little above.
    #[default]
    Orbit,
    /// From the south, looking north.
    Side,
    /// From above, north up.
    Top,
    /// From the east, looking west.
    Front,
    /// Behind the whale.
    Whale,
}

impl View {
    /// Every view, in the order of menus.
    pub const ALL: [Self; 5] = [Self::Orbit, Self::Side, Self::Top, Self::Front, Self::Whale];

    /// Its name on the command line and in menus.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit",
            Self::Side => "side",
            Self::Top => "top",
            Self::Front => "front",
            Self::Whale => "whale",
        }
    }

    /// The view of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|view| view.name() == name)
    }
}

/// A camera that orbits a target; z is up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// What it looks at [m].
    pub target: DVec3,
    /// Distance from the target [m].
    pub distance_m: f64,
    /// Direction from target to eye, anticlockwise from east seen from above [rad].
    pub azimuth: f64,
    /// Height of the eye above the target's level [rad].
    pub elevation: f64,
    /// Whole angle of view, bottom to top [rad].
    pub field_of_view: f64,
}

/// Nearest to straight up or down that the eye may go, so that "up" stays defined [rad].
const STEEPEST: f64 = 1.5705;
/// Angle of view of a free orbit: wide enough for depth [rad].
const FREE_ANGLE: f64 = 0.6;
/// Angle of view of side, top and front: so narrow that lengths compare all over the picture [rad].
const FLAT_ANGLE: f64 = 0.12;
/// Air round what is framed, as a factor on its size.
const MARGIN: f64 = 1.08;
/// Angle of view when flying [rad].
const FLY_ANGLE: f64 = 1.0;

impl Default for Camera {
    fn default() -> Self {
        Self { target: DVec3::ZERO, distance_m: 100.0, azimuth: -1.1, elevation: 0.12, field_of_view: FREE_ANGLE }
    }
}

impl Camera {
    /// A camera at a named view with all of `places` in sight; `aspect` is width over height.
    #[must_use]
    pub fn of_view(view: View, places: &[DVec3], whale: Option<&WhaleFrame>, length_m: f64, aspect: f64) -> Self {
        let quarter = std::f64::consts::FRAC_PI_2;
        let mut camera = Self::default();
        (camera.azimuth, camera.elevation, camera.field_of_view) = match view {
            View::Orbit | View::Whale => (-1.1, 0.12, FREE_ANGLE),
            View::Side => (-quarter, 0.0, FLAT_ANGLE),
            View::Top => (-quarter, STEEPEST, FLAT_ANGLE),
            View::Front => (0.0, 0.0, FLAT_ANGLE),
        };
        match (view, whale) {
            (View::Whale, Some(whale)) => camera.follow(whale, length_m),
            _ => camera.frame(places, aspect),
        }
        camera
    }

    /// Moves so that `places` fill the picture.
    pub fn frame(&mut self, places: &[DVec3], aspect: f64) {
        self.target = Bounds::of(places.iter().copied()).centre();
        // What is near looks larger, so the middle of the picture is not that of the places: centre, then fit, until both hold.
        for _ in 0..4 {
            self.distance_m = self.fitting_distance(places, aspect);
            let (right, up, _) = self.axes();
            let (least, most) = self.extent(places);
            let middle = (least + most) * 0.5 * self.distance_m;
            self.target += right * middle.x + up * middle.y;
        }
        self.distance_m = self.fitting_distance(places, aspect);
    }

    /// Least distance at which every place is in sight [m]: one is where its offset across is at most
    /// its distance ahead times the tangent of the half angle.
    fn fitting_distance(&self, places: &[DVec3], aspect: f64) -> f64 {
        let (right, up, ahead) = self.axes();
        let height = (self.field_of_view / 2.0).tan() / MARGIN;
        let needed = |place: &DVec3| {
            let from = *place - self.target;
            let across = (from.dot(up).abs() / height).max(from.dot(right).abs() / (height * aspect.max(0.1)));
            across - from.dot(ahead)
        };
        places.iter().map(needed).fold(1.0, f64::max)
    }

    /// Least and greatest tangent of the places from the middle of the picture, across and up.
    fn extent(&self, places: &[DVec3]) -> (DVec2, DVec2) {
        let ((right, up, ahead), eye) = (self.axes(), self.eye());
        let tangent = |place: &DVec3| {
            let from = *place - eye;
            DVec2::new(from.dot(right), from.dot(up)) / from.dot(ahead).max(1e-6)
        };
        places.iter().map(tangent).fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(least, most), at| (least.min(at), most.max(at)))
    }

    /// Third person: behind and above the whale, looking where it looks.
    pub fn follow(&mut self, whale: &WhaleFrame, length_m: f64) {
        let ahead = whale.orientation * DVec3::X;
        self.target = whale.position + ahead * (0.25 * length_m);
        self.azimuth = (-ahead.y).atan2(-ahead.x) + 0.25;
        self.elevation = 0.22;
        self.distance_m = 1.6 * length_m;
        self.field_of_view = FLY_ANGLE;
    }

    /// First person: at the whale's head, looking ahead.
    pub fn first_person(&mut self, whale: &WhaleFrame, length_m: f64) {
        let ahead = whale.orientation * DVec3::X;
        let eye = whale.position + ahead * (0.52 * length_m) + whale.orientation * DVec3::Z * (0.08 * length_m);
        self.distance_m = 10.0;
        self.target = eye + ahead * self.distance_m;
        self.azimuth = (-ahead.y).atan2(-ahead.x);
        self.elevation = (-ahead.z).clamp(-1.0, 1.0).asin();
        self.field_of_view = FLY_ANGLE;
    }

    /// Where the eye is [m].
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        let (sin, cos) = self.azimuth.sin_cos();
        let (up, out) = self.elevation.sin_cos();
        self.target + DVec3::new(out * cos, out * sin, up) * self.distance_m
    }

    /// Unit vectors to the right, up, and from the eye to the target.
    #[must_use]
    pub fn axes(&self) -> (DVec3, DVec3, DVec3) {
        let ahead = (self.target - self.eye()).normalize_or_zero();
        let right = DVec3::new(-self.azimuth.sin(), self.azimuth.cos(), 0.0);
        (right, right.cross(ahead), ahead)
    }

    /// Turns about the target by a drag [points].
    pub fn orbit(&mut self, drag: DVec2) {
        self.azimuth -= drag.x * 0.008;
        self.elevation = (self.elevation + drag.y * 0.008).clamp(-STEEPEST, STEEPEST);
        if self.field_of_view < FREE_ANGLE {
            self.widen();
        }
    }

    /// Goes from a flat view to the free angle, keeping the target's size on screen.
    fn widen(&mut self) {
        self.distance_m *= (self.field_of_view / 2.0).tan() / (FREE_ANGLE / 2.0).tan();
        self.field_of_view = FREE_ANGLE;
    }

    /// Moves the target with a drag, so that the point under the pointer follows it; `height` is the picture's [points].
    pub fn pan(&mut self, drag: DVec2, height: f64) {
        let (right, up, _) = self.axes();
        let metres = self.metres_a_point(height);
        self.target += (up * drag.y - right * drag.x) * metres;
    }

    /// Comes nearer by a share for each notch of a wheel.
    pub fn zoom(&mut self, notches: f64) {
        self.distance_m = (self.distance_m * 0.88_f64.powf(notches)).clamp(0.5, 20_000.0);
    }

    /// Length that one point of the picture spans at the target [m].
    #[must_use]
    pub fn metres_a_point(&self, height: f64) -> f64 {
        2.0 * self.distance_m * (self.field_of_view / 2.0).tan() / height.max(1.0)
    }

    /// From world to clip space, OpenGL's way; `aspect` is width over height.
    #[must_use]
    pub fn matrix(&self, aspect: f64) -> DMat4 {
        let (right, up, ahead) = self.axes();
        let eye = self.eye();
        let view = DMat4::from_cols(
            DVec4::new(right.x, up.x, -ahead.x, 0.0),
            DVec4::new(right.y, up.y, -ahead.y, 0.0),
            DVec4::new(right.z, up.z, -ahead.z, 0.0),
            DVec4::new(-right.dot(eye), -up.dot(eye), ahead.dot(eye), 1.0),
        );
        let (near, far) = ((self.distance_m * 0.02).max(0.05), self.distance_m * 4.0 + 3000.0);
        let height = 1.0 / (self.field_of_view / 2.0).tan();
        let projection = DMat4::from_cols(
            DVec4::new(height / aspect, 0.0, 0.0, 0.0),
            DVec4::new(0.0, height, 0.0, 0.0),
            DVec4::new(0.0, 0.0, -(far + near) / (far - near), -1.0),
            DVec4::new(0.0, 0.0, -2.0 * far * near / (far - near), 0.0),
        );
        projection * view
    }

    /// Where a place falls in a picture of `size`, from its top left corner [points]; `None` behind the eye.
    #[must_use]
    pub fn project(&self, place: DVec3, size: DVec2) -> Option<DVec2> {
        let clip = self.matrix(size.x / size.y.max(1.0)) * place.extend(1.0);
        (clip.w > 0.0).then(|| DVec2::new((clip.x / clip.w + 1.0) * 0.5 * size.x, (1.0 - clip.y / clip.w) * 0.5 * size.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use endline_sim::DQuat;

    const SIZE: DVec2 = DVec2::new(800.0, 600.0);

    fn gear() -> Bounds {
        Bounds::of([DVec3::new(-5.0, -8.0, -40.0), DVec3::new(60.0, 4.0, 1.0)])
    }

    #[test]
    fn every_view_shows_all_of_the_gear() {
        for view in [View::Orbit, View::Side, View::Top, View::Front] {
            let camera = Camera::of_view(view, &gear().corners(), None, 13.0, SIZE.x / SIZE.y);
            for corner in gear().corners() {
                let at = camera.project(corner, SIZE).unwrap();
                let inside = at.x > 0.0 && at.x < SIZE.x && at.y > 0.0 && at.y < SIZE.y;
                assert!(inside, "{view:?}: {corner} falls at {at}");
            }
        }
    }

    #[test]
    fn what_is_framed_fills_the_picture_and_stands_in_its_middle() {
        let places =
            [DVec3::new(0.0, 0.0, -25.0), DVec3::new(17.0, 2.0, 0.0), DVec3::new(8.0, -21.0, -12.0), DVec3::new(8.0, -35.0, -12.0)];
        for view in [View::Orbit, View::Side, View::Top, View::Front] {
            let camera = Camera::of_view(view, &places, None, 13.0, SIZE.x / SIZE.y);
            let at = places.map(|place| camera.project(place, SIZE).unwrap());
            let (least, most) = at.into_iter().fold((at[0], at[0]), |(least, most), at| (least.min(at), most.max(at)));
            let share = (most - least) / SIZE;
            assert!(share.max_element() > 0.85 && share.max_element() < 0.97, "{view:?}: {share}");
            assert!(((least + most) / 2.0 - SIZE / 2.0).length() < 12.0, "{view:?}: {least} to {most}");
        }
    }

    #[test]
    fn east_is_right_and_up_is_up_from_the_south_and_north_is_up_from_above() {
        let side = Camera::of_view(View::Side, &gear().corners(), None, 13.0, 1.0);
        assert!(side.project(DVec3::new(50.0, 0.0, -20.0), SIZE).unwrap().x > side.project(DVec3::new(0.0, 0.0, -20.0), SIZE).unwrap().x);
        assert!(side.project(DVec3::ZERO, SIZE).unwrap().y < side.project(DVec3::new(0.0, 0.0, -30.0), SIZE).unwrap().y);
        let top = Camera::of_view(View::Top, &gear().corners(), None, 13.0, 1.0);
        assert!(top.project(DVec3::new(0.0, 3.0, 0.0), SIZE).unwrap().y < top.project(DVec3::new(0.0, -3.0, 0.0), SIZE).unwrap().y);
    }

    #[test]
    fn the_target_is_in_the_middle_and_the_scale_is_that_of_the_projection() {
        let camera = Camera { target: DVec3::new(3.0, 4.0, -10.0), distance_m: 25.0, ..Camera::default() };
        let middle = camera.project(camera.target, SIZE).unwrap();
        assert!((middle - SIZE / 2.0).length() < 1e-9);
        let (right, ..) = camera.axes();
        let beside = camera.project(camera.target + right * 2.0, SIZE).unwrap();
        assert!(((beside.x - middle.x) * camera.metres_a_point(SIZE.y) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_pan_moves_the_picture_with_the_pointer() {
        let mut camera = Camera::default();
        let place = camera.target;
        camera.pan(DVec2::new(30.0, -20.0), SIZE.y);
        let at = camera.project(place, SIZE).unwrap();
        assert!((at - (SIZE / 2.0 + DVec2::new(30.0, -20.0))).length() < 0.5, "{at}");
    }

    #[test]
    fn following_looks_the_way_the_whale_swims() {
        let orientation = DQuat::from_rotation_z(2.0);
        let whale = WhaleFrame { position: DVec3::new(9.0, 1.0, -12.0), orientation, speed_m_s: 1.0, posture: Default::default() };
        let mut camera = Camera::default();
        camera.follow(&whale, 13.0);
        assert!(camera.axes().2.dot(orientation * DVec3::X) > 0.9);
        camera.first_person(&whale, 13.0);
        assert!((camera.axes().2 - orientation * DVec3::X).length() < 1e-9);
    }
}
