//! Gamepads behind a trait, so that tests fly by script.

use std::collections::VecDeque;

/// A stick or trigger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PadAxis {
    /// Left stick, right is 1.
    LeftX,
    /// Left stick, up (away from the pilot) is 1.
    LeftY,
    /// Right stick, right is 1.
    RightX,
    /// Right stick, up (away from the pilot) is 1.
    RightY,
    /// Left trigger, pulled is 1.
    LeftTrigger,
    /// Right trigger, pulled is 1.
    RightTrigger,
}

/// A button the pilot uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PadButton {
    /// Lower face button (A).
    South,
    /// Right face button (B).
    East,
    /// Upper face button (Y).
    North,
    /// Left shoulder.
    LeftShoulder,
    /// Right shoulder.
    RightShoulder,
    /// Left stick pressed.
    LeftStick,
    /// Right stick pressed.
    RightStick,
    /// Start.
    Start,
    /// Back, also called select.
    Back,
}

/// Something a pad did.
#[derive(Clone, Debug, PartialEq)]
pub enum PadEvent {
    /// A pad of this name is there.
    Connected(String),
    /// The pad is gone.
    Disconnected,
    /// A stick or trigger moved to a value, -1 to 1 (triggers 0 to 1).
    Moved(PadAxis, f64),
    /// A button went down.
    Pressed(PadButton),
    /// A button came up.
    Released(PadButton),
}

/// Where pad events come from.
pub trait PadSource {
    /// Adds what happened since the last call.
    fn poll(&mut self, out: &mut Vec<PadEvent>);
}

/// Pads of this machine, by gilrs.
pub struct GilrsPads {
    gilrs: gilrs::Gilrs,
    announced: bool,
}

impl GilrsPads {
    /// Looks for pads; none is no error.
    ///
    /// # Errors
    /// Where the system gives no access to pads at all.
    pub fn new() -> Result<Self, String> {
        let gilrs = gilrs::Gilrs::new().map_err(|error| format!("gamepads cannot be read: {error}"))?;
        Ok(Self { gilrs, announced: false })
    }
}

impl PadSource for GilrsPads {
    fn poll(&mut self, out: &mut Vec<PadEvent>) {
        if !self.announced {
            self.announced = true;
            out.extend(self.gilrs.gamepads().map(|(_, pad)| PadEvent::Connected(pad.name().to_owned())));
        }
        while let Some(event) = self.gilrs.next_event() {
            let translated = match event.event {
                gilrs::EventType::Connected => Some(PadEvent::Connected(self.gilrs.gamepad(event.id).name().to_owned())),
                gilrs::EventType::Disconnected => Some(PadEvent::Disconnected),
                gilrs::EventType::AxisChanged(axis, value, _) => axis_of(axis).map(|axis| PadEvent::Moved(axis, f64::from(value))),
                gilrs::EventType::ButtonChanged(gilrs::Button::LeftTrigger2, value, _) => {
                    Some(PadEvent::Moved(PadAxis::LeftTrigger, f64::from(value)))
                }
                gilrs::EventType::ButtonPressed(button, _) => button_of(button).map(PadEvent::Pressed),
                gilrs::EventType::ButtonReleased(button, _) => button_of(button).map(PadEvent::Released),
                gilrs::EventType::ButtonChanged(gilrs::Button::RightTrigger2, value, _) => {
                    Some(PadEvent::Moved(PadAxis::RightTrigger, f64::from(value)))
                }
                _ => None,
            };
            out.extend(translated);
        }
    }
}

fn axis_of(axis: gilrs::Axis) -> Option<PadAxis> {
    match axis {
        gilrs::Axis::LeftStickX => Some(PadAxis::LeftX),
        gilrs::Axis::LeftStickY => Some(PadAxis::LeftY),
        gilrs::Axis::RightStickX => Some(PadAxis::RightX),
        gilrs::Axis::RightStickY => Some(PadAxis::RightY),
        _ => None,
    }
}

fn button_of(button: gilrs::Button) -> Option<PadButton> {
    match button {
        gilrs::Button::South => Some(PadButton::South),
        gilrs::Button::East => Some(PadButton::East),
        gilrs::Button::North => Some(PadButton::North),
        gilrs::Button::LeftTrigger => Some(PadButton::LeftShoulder),
        gilrs::Button::RightTrigger => Some(PadButton::RightShoulder),
        gilrs::Button::LeftThumb => Some(PadButton::LeftStick),
        gilrs::Button::RightThumb => Some(PadButton::RightStick),
        gilrs::Button::Start => Some(PadButton::Start),
        gilrs::Button::Select => Some(PadButton::Back),
        _ => None,
    }
}

/// A pad that does what it was told, one entry a poll.
#[derive(Clone, Debug, Default)]
pub struct ScriptedPad {
    /// What is still to come: the events of each poll.
    pub script: VecDeque<Vec<PadEvent>>,
}

impl PadSource for ScriptedPad {
    fn poll(&mut self, out: &mut Vec<PadEvent>) {
        out.extend(self.script.pop_front().unwrap_or_default());
    }
}
