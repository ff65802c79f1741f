//! A gear type: one trap, an endline of one rope, a buoy; the buoy is let go when the line pulls too hard for too long.

use endline_sdk::{
    Attribute, AttributeValue, BodyKind, Descriptor, GearAction, GearStep, GearType, HookError, LineEnd, Rig, RigBody, RigEnd, RigLine, Site,
};

struct Simple(Descriptor);

impl Simple {
    fn new() -> Self {
        let attributes = vec![
            Attribute::item("trap", "traps", "wire-lobster-3ft", "The trap."),
            Attribute::item("rope", "ropes", "sink-3-8", "Rope of the endline."),
            Attribute::item("buoy", "buoys", "bullet-6x14", "The buoy."),
            Attribute::number("scope", "1", [1.0, 5.0], 1.4, "Length of the endline as a multiple of water depth."),
            Attribute::number("lets_go_above", "N", [10.0, 1e5], 3000.0, "Pull at the buoy above which it is let go, after a second."),
        ];
        // One float, kept by the program: for how long the pull has been too hard [s].
        Self(Descriptor::new("@id@", "@title@", "One trap that lets its buoy go.").with_attributes(attributes).with_state(1))
    }
}

impl GearType for Simple {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    /// Parts with a first guess of their places; the program finds their rest.
    fn build(&self, values: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let item = |i: usize| values[i].item().filter(|id| !id.is_empty()).map(str::to_owned);
        let item = |i: usize| item(i).ok_or_else(|| HookError::new(format!("`{}` names no item", self.0.attributes[i].key)));
        let scope = values[3].number().unwrap_or(1.4);
        if site.depth_m < 2.0 {
            return Err(HookError::new(format!("{} m of water is too shallow", site.depth_m)));
        }
        let body = |id: &str, kind, item, z| RigBody { id: id.into(), kind, item, position_m: [0.0, 0.0, z] };
        let bodies = vec![body("trap", BodyKind::Trap, item(0)?, -site.depth_m), body("buoy", BodyKind::Buoy, item(2)?, 0.0)];
        let line = RigLine {
            id: "endline".into(),
            rope: item(1)?,
            from: RigEnd::Body("trap".into()),
            to: RigEnd::Body("buoy".into()),
            length_m: scope * site.depth_m,
            laid_m: Vec::new(),
        };
        Ok(Rig { bodies, lines: vec![line], ..Rig::default() })
    }

    /// Once a step; lines are counted in the order built.
    fn step(
        &self,
        values: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let pull_n = input.end_tension_n[0][1];
        let too_hard = values[4].number().is_some_and(|most| pull_n > most);
        state[0] = if too_hard { state[0] + input.dt_s } else { 0.0 };
        if state[0] > 1.0 && state[0] - input.dt_s <= 1.0 {
            actions.push(GearAction::CutLine { line: 0, end: LineEnd::B });
        }
        Ok(())
    }
}

endline_sdk::export_plugin! {
    about: "Who made this, and where its figures come from.";
    gear: Simple::new()
}
