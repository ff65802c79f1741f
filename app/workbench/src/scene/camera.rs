//! The camera: an orbit about a target, named views, and views that follow the whale.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use endline_sim::frame::WhaleFrame;
use glam::{DMat4, DVec2, DVec3, DVec4};
use strum::{EnumString, IntoStaticStr};

use endline_session::scene::Bounds;

/// Named views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, EnumString, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
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
    /// Third person: behind the whale and above it.
    Whale,
    /// First person: from the whale's head, over its rostrum.
    FirstPerson,
    /// First person: from the whale's left eye.
    LeftEye,
    /// First person: from the whale's right eye.
    RightEye,
    /// The whale alone, from its starboard side.
    WhaleSide,
    /// The whale alone, from above.
    WhaleTop,
    /// The whale alone, from ahead.
    WhaleFront,
}

impl View {
    /// Views of everything, in the order of menus.
    pub const WHOLE: [Self; 4] = [Self::Orbit, Self::Side, Self::Top, Self::Front];
    /// Views of the whale or from it, in the order of menus.
    pub const OF_WHALE: [Self; 7] = [
        Self::Whale,
        Self::FirstPerson,
        Self::LeftEye,
        Self::RightEye,
        Self::WhaleSide,
        Self::WhaleTop,
        Self::WhaleFront,
    ];

    /// All views.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::WHOLE.into_iter().chain(Self::OF_WHALE)
    }

    /// Whether the camera follows the whale.
    pub fn is_of_whale(self) -> bool {
        Self::OF_WHALE.contains(&self)
    }

    /// Whether it is seen by the whale itself.
    pub fn is_first_person(self) -> bool {
        matches!(self, Self::FirstPerson | Self::LeftEye | Self::RightEye)
    }

    /// Its name on the command line and in menus.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Names of all views, for messages.
    pub fn names() -> String {
        Self::all().map(Self::name).collect::<Vec<_>>().join(", ")
    }

    /// Finds a view by name.
    pub fn named(name: &str) -> Option<Self> {
        name.parse().ok()
    }
}

/// A camera that orbits a target; z is up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Point in the middle of the picture [m].
    pub target: DVec3,
    /// Distance from the target [m].
    pub distance_m: f64,
    /// Direction from target to eye, anticlockwise from east seen from above [rad].
    pub azimuth: f64,
    /// Height of the eye above the target's level [rad].
    pub elevation: f64,
    /// Vertical angle of view [rad].
    pub field_of_view: f64,
    /// Roll to starboard about the line of sight [rad].
    pub roll: f64,
}

/// Greatest elevation, less than vertical so that "up" stays defined [rad].
const STEEPEST: f64 = 1.5705;
/// Angle of view of a free orbit: wide enough for an impression of depth [rad].
const FREE_ANGLE: f64 = 0.6;
/// Angle of view of side, top and front: narrow, so that lengths are comparable across the picture [rad].
const FLAT_ANGLE: f64 = 0.12;
/// Margin around what is framed, as a factor on its size.
const MARGIN: f64 = 1.08;
/// Width of a portrait of the whale [body lengths].
const PORTRAIT: f64 = 1.2;
/// Angle of view when flying behind the whale [rad].
const FLY_ANGLE: f64 = 1.0;
/// Angle of view from the whale's head: its rostrum is visible [rad].
const HEAD_ANGLE: f64 = 1.25;

/// An eye in the whale's frame, just outside its skin: ahead of the middle, to the side and up [body lengths].
const EYE: [f64; 3] = [0.292, 0.1, 0.0];
/// Direction of an eye's view from straight ahead [rad]. Eyes of right whales look to the sides.
const EYE_TURN: f64 = 1.15;

impl Default for Camera {
    fn default() -> Self {
        Self {
            target: DVec3::ZERO,
            distance_m: 100.0,
            azimuth: -1.1,
            elevation: 0.12,
            field_of_view: FREE_ANGLE,
            roll: 0.0,
        }
    }
}

impl Camera {
    /// A camera at a named view that shows all `places`; `aspect` is width over height.
    pub fn of_view(
        view: View,
        places: &[DVec3],
        whale: Option<&WhaleFrame>,
        length_m: f64,
        aspect: f64,
    ) -> Self {
        let mut camera = Self::default();
        match whale.filter(|_| view.is_of_whale()) {
            Some(whale) => camera.follow(view, whale, length_m, aspect),
            None => camera.show_all(view, places, aspect),
        }
        camera
    }

    /// Shows all `places` from the direction of a view.
    fn show_all(&mut self, view: View, places: &[DVec3], aspect: f64) {
        (self.azimuth, self.elevation, self.field_of_view) = match view {
            View::Side | View::WhaleSide => (-FRAC_PI_2, 0.0, FLAT_ANGLE),
            View::Top | View::WhaleTop => (-FRAC_PI_2, STEEPEST, FLAT_ANGLE),
            View::Front | View::WhaleFront => (0.0, 0.0, FLAT_ANGLE),
            View::Orbit | View::Whale | View::FirstPerson | View::LeftEye | View::RightEye => {
                (-1.1, 0.12, FREE_ANGLE)
            }
        };
        self.roll = 0.0;
        self.frame(places, aspect);
    }

    /// Moves to a view of the whale or from it; any other view is third person.
    pub fn follow(&mut self, view: View, whale: &WhaleFrame, length_m: f64, aspect: f64) {
        let ahead = whale.orientation * DVec3::X;
        let heading = ahead.y.atan2(ahead.x);
        match view {
            View::FirstPerson => self.first_person(whale, length_m),
            View::LeftEye => self.by_eye(whale, length_m, 1.0),
            View::RightEye => self.by_eye(whale, length_m, -1.0),
            View::WhaleSide => self.portrait(whale, [heading - FRAC_PI_2, 0.0], length_m, aspect),
            View::WhaleTop => {
                self.portrait(whale, [heading - FRAC_PI_2, STEEPEST], length_m, aspect)
            }
            View::WhaleFront => self.portrait(whale, [heading, 0.0], length_m, aspect),
            _ => self.third_person(whale, length_m),
        }
    }

    /// Shows the whale alone from an azimuth and elevation [rad], with a narrow angle of view.
    fn portrait(
        &mut self,
        whale: &WhaleFrame,
        [azimuth, elevation]: [f64; 2],
        length_m: f64,
        aspect: f64,
    ) {
        (self.azimuth, self.elevation, self.field_of_view, self.roll) =
            (azimuth, elevation, FLAT_ANGLE, 0.0);
        self.target = whale.position;
        self.distance_m = PORTRAIT * length_m / (2.0 * (FLAT_ANGLE / 2.0).tan() * aspect.max(0.1));
    }

    /// Moves so that `places` fill the picture.
    pub fn frame(&mut self, places: &[DVec3], aspect: f64) {
        self.target = Bounds::of(places.iter().copied()).centre();
        // Perspective moves the middle of the picture away from that of the places: alternate fitting and centring.
        for _ in 0..4 {
            self.distance_m = self.fitting_distance(places, aspect);
            let (right, up, _) = self.axes();
            let (least, most) = self.extent(places);
            let middle = (least + most) * 0.5 * self.distance_m;
            self.target += right * middle.x + up * middle.y;
        }
        self.distance_m = self.fitting_distance(places, aspect);
    }

    /// Least distance at which every place is visible [m]: its lateral offset is at most its distance ahead times the tangent of half the
    /// angle of view.
    fn fitting_distance(&self, places: &[DVec3], aspect: f64) -> f64 {
        let (right, up, ahead) = self.axes();
        let height = (self.field_of_view / 2.0).tan() / MARGIN;
        let needed = |place: &DVec3| {
            let from = *place - self.target;
            let across = (from.dot(up).abs() / height)
                .max(from.dot(right).abs() / (height * aspect.max(0.1)));
            across - from.dot(ahead)
        };
        places.iter().map(needed).fold(1.0, f64::max)
    }

    /// Least and greatest tangent of the angle of the places to the line of sight, across and up.
    fn extent(&self, places: &[DVec3]) -> (DVec2, DVec2) {
        let ((right, up, ahead), eye) = (self.axes(), self.eye());
        let tangent = |place: &DVec3| {
            let from = *place - eye;
            DVec2::new(from.dot(right), from.dot(up)) / from.dot(ahead).max(1e-6)
        };
        places
            .iter()
            .map(tangent)
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(least, most), at| {
                (least.min(at), most.max(at))
            })
    }

    /// Third person: behind and above the whale, in the direction of its head.
    pub fn third_person(&mut self, whale: &WhaleFrame, length_m: f64) {
        let ahead = whale.orientation * DVec3::X;
        self.target = whale.position + ahead * (0.25 * length_m);
        self.azimuth = (-ahead.y).atan2(-ahead.x) + 0.25;
        self.elevation = 0.22;
        self.distance_m = 1.6 * length_m;
        (self.field_of_view, self.roll) = (FLY_ANGLE, 0.0);
    }

    /// First person: from above and behind the whale's blowholes ahead over its rostrum, rolled with the whale.
    pub fn first_person(&mut self, whale: &WhaleFrame, length_m: f64) {
        let place = DVec3::new(0.27, 0.0, 0.115) * length_m;
        self.look_out(whale, place, DVec3::X);
    }

    /// First person from an eye, to port (1) or starboard (-1): out to the side and a little ahead and down.
    fn by_eye(&mut self, whale: &WhaleFrame, length_m: f64, side: f64) {
        let place = DVec3::new(EYE[0], side * EYE[1], EYE[2]) * length_m;
        let (sin, cos) = EYE_TURN.sin_cos();
        self.look_out(whale, place, DVec3::new(cos, side * sin, -0.1).normalize());
    }

    /// Looks from a place in the whale's frame [m] in a direction in that frame, rolled with the whale.
    fn look_out(&mut self, whale: &WhaleFrame, place: DVec3, direction: DVec3) {
        let ahead = whale.orientation * direction;
        let dorsal = whale.orientation * DVec3::Z;
        self.distance_m = 10.0;
        self.target = whale.position + whale.orientation * place + ahead * self.distance_m;
        self.azimuth = (-ahead.y).atan2(-ahead.x);
        self.elevation = (-ahead.z).clamp(-1.0, 1.0).asin();
        (self.field_of_view, self.roll) = (HEAD_ANGLE, 0.0);
        let (right, up, _) = self.axes();
        self.roll = dorsal.dot(right).atan2(dorsal.dot(up));
    }

    /// Position of the eye [m].
    pub fn eye(&self) -> DVec3 {
        let (sin, cos) = self.azimuth.sin_cos();
        let (up, out) = self.elevation.sin_cos();
        self.target + DVec3::new(out * cos, out * sin, up) * self.distance_m
    }

    /// Unit vectors to the right, up, and from the eye to the target.
    pub fn axes(&self) -> (DVec3, DVec3, DVec3) {
        let ahead = (self.target - self.eye()).normalize_or_zero();
        let level = DVec3::new(-self.azimuth.sin(), self.azimuth.cos(), 0.0);
        let (sin, cos) = self.roll.sin_cos();
        let right = level * cos - level.cross(ahead) * sin;
        (right, right.cross(ahead), ahead)
    }

    /// Orbits the target by a drag [points].
    pub fn orbit(&mut self, drag: DVec2) {
        self.azimuth -= drag.x * 0.008;
        self.elevation = (self.elevation + drag.y * 0.008).clamp(-STEEPEST, STEEPEST);
        if self.field_of_view < FREE_ANGLE {
            self.widen();
        }
    }

    /// Changes a flat view to the free angle of view without changing the size of the target on screen.
    fn widen(&mut self) {
        self.distance_m *= (self.field_of_view / 2.0).tan() / (FREE_ANGLE / 2.0).tan();
        self.field_of_view = FREE_ANGLE;
    }

    /// Moves the target by a drag, so that the point under the pointer follows it; `height` is that of the picture [points].
    pub fn pan(&mut self, drag: DVec2, height: f64) {
        let (right, up, _) = self.axes();
        let metres = self.metres_a_point(height);
        self.target += (up * drag.y - right * drag.x) * metres;
    }

    /// Moves closer by a constant factor for each notch of a wheel.
    pub fn zoom(&mut self, notches: f64) {
        self.distance_m = (self.distance_m * 0.88_f64.powf(notches)).clamp(0.5, 20_000.0);
    }

    /// As [`zoom`](Self::zoom), but what is under a point `at` of a picture of `size` [points] stays there.
    pub fn zoom_at(&mut self, notches: f64, at: DVec2, size: DVec2) {
        let ((eye, ray), (_, _, ahead)) = (self.ray(at, size), self.axes());
        let fixed = eye + ray * (self.distance_m / ray.dot(ahead).max(1e-6));
        let before_m = self.distance_m;
        self.zoom(notches);
        self.target = fixed + (self.target - fixed) * (self.distance_m / before_m);
    }

    /// Interpolates between this camera and another by a share, 0 to 1. Angles take the shorter way; the length that the picture spans at
    /// the target is interpolated geometrically, so that zooming appears even, also between a flat and a wide view.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let linear = |from: f64, to: f64| from + (to - from) * share;
        let angle = |from: f64, to: f64| from + ((to - from + PI).rem_euclid(TAU) - PI) * share;
        let span_m = |camera: &Self| camera.distance_m * (camera.field_of_view / 2.0).tan();
        let field_of_view = linear(self.field_of_view, other.field_of_view);
        let spanned_m = span_m(self) * (span_m(other) / span_m(self)).powf(share);
        Self {
            target: self.target.lerp(other.target, share),
            distance_m: spanned_m / (field_of_view / 2.0).tan(),
            azimuth: angle(self.azimuth, other.azimuth),
            elevation: linear(self.elevation, other.elevation),
            field_of_view,
            roll: angle(self.roll, other.roll),
        }
    }

    /// Length that one point of the picture spans at the target [m].
    pub fn metres_a_point(&self, height: f64) -> f64 {
        2.0 * self.distance_m * (self.field_of_view / 2.0).tan() / height.max(1.0)
    }

    /// Matrix from world to clip space of OpenGL; `aspect` is width over height.
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

    /// Position of the eye [m], and the unit vector from it through a point of a picture of `size`, from its top left corner [points].
    pub fn ray(&self, at: DVec2, size: DVec2) -> (DVec3, DVec3) {
        let (right, up, ahead) = self.axes();
        let half = (self.field_of_view / 2.0).tan();
        let x = (2.0 * at.x / size.x.max(1.0) - 1.0) * half * size.x / size.y.max(1.0);
        let y = (1.0 - 2.0 * at.y / size.y.max(1.0)) * half;
        (self.eye(), (ahead + right * x + up * y).normalize_or_zero())
    }

    /// Position of a place in a picture of `size`, from its top left corner [points]; `None` behind the eye.
    pub fn project(&self, place: DVec3, size: DVec2) -> Option<DVec2> {
        let clip = self.matrix(size.x / size.y.max(1.0)) * place.extend(1.0);
        (clip.w > 0.0).then(|| {
            DVec2::new(
                (clip.x / clip.w + 1.0) * 0.5 * size.x,
                (1.0 - clip.y / clip.w) * 0.5 * size.y,
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use endline_sim::DQuat;

    const SIZE: DVec2 = DVec2::new(800.0, 600.0);

    /// A whale at a depth of 12 m.
    fn swimming(orientation: DQuat) -> WhaleFrame {
        WhaleFrame {
            position: DVec3::new(9.0, 1.0, -12.0),
            orientation,
            speed_m_s: 1.0,
            posture: Default::default(),
            exertion: Default::default(),
        }
    }

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
                assert!(inside, "{view:?}: {corner} is drawn at {at}");
            }
        }
    }

    #[test]
    fn framed_places_fill_the_picture_and_are_centred() {
        let places = [
            DVec3::new(0.0, 0.0, -25.0),
            DVec3::new(17.0, 2.0, 0.0),
            DVec3::new(8.0, -21.0, -12.0),
            DVec3::new(8.0, -35.0, -12.0),
        ];
        for view in [View::Orbit, View::Side, View::Top, View::Front] {
            let camera = Camera::of_view(view, &places, None, 13.0, SIZE.x / SIZE.y);
            let at = places.map(|place| camera.project(place, SIZE).unwrap());
            let (least, most) = at
                .into_iter()
                .fold((at[0], at[0]), |(least, most), at| (least.min(at), most.max(at)));
            let share = (most - least) / SIZE;
            assert!(share.max_element() > 0.85 && share.max_element() < 0.97, "{view:?}: {share}");
            assert!(
                ((least + most) / 2.0 - SIZE / 2.0).length() < 12.0,
                "{view:?}: {least} to {most}"
            );
        }
    }

    #[test]
    fn east_is_right_and_up_is_up_in_the_side_view_and_north_is_up_in_the_top_view() {
        let side = Camera::of_view(View::Side, &gear().corners(), None, 13.0, 1.0);
        assert!(
            side.project(DVec3::new(50.0, 0.0, -20.0), SIZE).unwrap().x
                > side.project(DVec3::new(0.0, 0.0, -20.0), SIZE).unwrap().x
        );
        assert!(
            side.project(DVec3::ZERO, SIZE).unwrap().y
                < side.project(DVec3::new(0.0, 0.0, -30.0), SIZE).unwrap().y
        );
        let top = Camera::of_view(View::Top, &gear().corners(), None, 13.0, 1.0);
        assert!(
            top.project(DVec3::new(0.0, 3.0, 0.0), SIZE).unwrap().y
                < top.project(DVec3::new(0.0, -3.0, 0.0), SIZE).unwrap().y
        );
    }

    #[test]
    fn the_target_is_in_the_middle_and_the_scale_matches_the_projection() {
        let camera =
            Camera { target: DVec3::new(3.0, 4.0, -10.0), distance_m: 25.0, ..Camera::default() };
        let middle = camera.project(camera.target, SIZE).unwrap();
        assert!((middle - SIZE / 2.0).length() < 1e-9);
        let (right, ..) = camera.axes();
        let beside = camera.project(camera.target + right * 2.0, SIZE).unwrap();
        assert!(((beside.x - middle.x) * camera.metres_a_point(SIZE.y) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_under_the_pointer_stays_there_when_zooming() {
        let mut camera =
            Camera::of_view(View::Orbit, &gear().corners(), None, 13.0, SIZE.x / SIZE.y);
        let at = DVec2::new(620.0, 140.0);
        let (eye, ray) = camera.ray(at, SIZE);
        let place = eye + ray * (camera.distance_m / ray.dot(camera.axes().2));
        let before_m = camera.distance_m;
        camera.zoom_at(3.0, at, SIZE);
        assert!((camera.distance_m / before_m - 0.88_f64.powi(3)).abs() < 1e-9);
        assert!(camera.project(place, SIZE).unwrap().distance(at) < 1e-6);
    }

    #[test]
    fn each_eye_sees_what_is_on_its_side_with_the_back_up() {
        let roll = DQuat::from_rotation_x(0.5);
        for (view, side) in [(View::LeftEye, 1.0), (View::RightEye, -1.0)] {
            let whale = swimming(roll);
            let camera = Camera::of_view(view, &[], Some(&whale), 13.0, SIZE.x / SIZE.y);
            let beside = whale.position + whale.orientation * DVec3::new(6.0, side * 8.0, 0.0);
            let over = beside + whale.orientation * DVec3::Z;
            let [low, high] = [beside, over].map(|place| camera.project(place, SIZE).unwrap());
            assert!(
                low.x > 0.0 && low.x < SIZE.x && high.y < low.y - 20.0,
                "{view:?} {low} {high}"
            );
            assert!((high.x - low.x).abs() < 0.2 * (low.y - high.y), "{view:?} {low} {high}");
            let beyond = whale.position - whale.orientation * DVec3::new(0.0, side * 8.0, 0.0);
            assert!(camera.project(beyond, SIZE).is_none(), "{view:?}");
        }
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
    fn an_interpolation_turns_by_the_shorter_way() {
        let [from, to] = [3.0, -3.0].map(|azimuth| Camera { azimuth, ..Camera::default() });
        let middle = from.towards(&to, 0.5);
        assert!((middle.azimuth - PI).abs() < 1e-12, "{}", middle.azimuth);
        assert!((from.towards(&to, 1.0).eye() - to.eye()).length() < 1e-9);
    }

    #[test]
    fn an_interpolation_from_a_flat_view_to_a_wide_one_keeps_the_span_of_the_picture() {
        let flat = Camera { field_of_view: FLAT_ANGLE, distance_m: 500.0, ..Camera::default() };
        let mut wide = flat.clone();
        wide.widen();
        for share in [0.0, 0.3, 0.7, 1.0] {
            let spans_m = flat.towards(&wide, share).metres_a_point(100.0);
            assert!(
                (spans_m / flat.metres_a_point(100.0) - 1.0).abs() < 1e-9,
                "{share}: {spans_m}"
            );
        }
    }

    #[test]
    fn a_following_camera_points_in_the_direction_of_the_whale() {
        let orientation = DQuat::from_rotation_z(2.0);
        let whale = swimming(orientation);
        let mut camera = Camera::default();
        camera.third_person(&whale, 13.0);
        assert!(camera.axes().2.dot(orientation * DVec3::X) > 0.9);
        camera.first_person(&whale, 13.0);
        assert!((camera.axes().2 - orientation * DVec3::X).length() < 1e-9);
    }

    #[test]
    fn first_person_rolls_with_the_whale() {
        for roll in [0.0, 0.7, -2.0] {
            let orientation = DQuat::from_rotation_z(-0.6)
                * DQuat::from_rotation_y(0.3)
                * DQuat::from_rotation_x(roll);
            let whale = swimming(orientation);
            let mut camera = Camera::default();
            camera.first_person(&whale, 13.0);
            let (right, up, _) = camera.axes();
            assert!((up - orientation * DVec3::Z).length() < 1e-9, "roll {roll}: up is {up}");
            assert!(
                (right - orientation * DVec3::NEG_Y).length() < 1e-9,
                "roll {roll}: right is {right}"
            );
        }
    }

    #[test]
    fn a_portrait_shows_the_whole_whale_with_its_snout_to_the_right() {
        let orientation = DQuat::from_rotation_z(2.0);
        let whale = swimming(orientation);
        for view in [View::WhaleSide, View::WhaleTop] {
            let camera = Camera::of_view(view, &[], Some(&whale), 13.0, SIZE.x / SIZE.y);
            let at = |x: f64| {
                camera.project(whale.position + orientation * DVec3::X * x, SIZE).unwrap().x
                    / SIZE.x
            };
            assert!(
                (0.85..0.95).contains(&at(6.5)) && (0.05..0.15).contains(&at(-6.5)),
                "{view:?}: {} to {}",
                at(-6.5),
                at(6.5)
            );
        }
    }
}
