"""Results of commands, one dataclass for each object of their JSON. Written by `app/python/forms.py` from `endline schema`."""

from __future__ import annotations

from dataclasses import dataclass

from ._records import Record


@dataclass(frozen=True)
class Counts(Record):
    """Number of rules with each verdict."""

    #: Rules that cannot be checked.
    cannot_be_checked: int
    #: Rules that it does not meet.
    fail: int
    #: Those of them that bind.
    fail_binding: int
    #: Rules that do not apply.
    not_applicable: int
    #: Rules that the gear meets.
    pass_: int


@dataclass(frozen=True)
class Measured(Record):
    """A measured value beside its limit."""

    #: Whether it holds.
    holds: bool
    #: The limit in SI units.
    limit: float | None
    #: The piece or line it was measured on; empty for the gear as a whole.
    part: str
    #: The comparison in words, such as `57 ft; at most 60 ft allowed`.
    says: str
    #: The sign between both.
    sign: str
    #: Their SI unit.
    unit: str
    #: The measured value in SI units; none where there is none.
    value: float | None


@dataclass(frozen=True)
class RuleResult(Record):
    """The verdict on a rule."""

    #: The requirement in words.
    asks: str
    #: Whether people are bound to it: it is law. A rule that does not bind is advice.
    binding: bool
    #: The law, or the page, that states it.
    cite: str
    #: How sure its wording is.
    confidence: str
    #: First day in force; none where it is unknown.
    from_: str | None
    #: Whose rule it is.
    jurisdiction: str
    #: The measured values, beside the limits.
    measured: list[Measured]
    #: Id of the pack.
    pack: str
    #: How to make gear that fails meet it; empty otherwise.
    remedy: str
    #: Id of the rule.
    rule: str
    #: Where its wording was read.
    source: str
    #: `law`, `voluntary` or `proposed`.
    standing: str
    #: Last day in force, where it has one.
    until: str | None
    #: The verdict.
    verdict: str
    #: Why it does not apply or cannot be checked; empty otherwise.
    why: str


@dataclass(frozen=True)
class RuleSheet(Record):
    """The verdict on every rule."""

    #: Id of the area.
    area: str
    #: Id of the assembly.
    assembly: str
    #: Number of rules with each verdict.
    counts: Counts
    #: Whether that depth was taken because none was given.
    depth_is_usual: bool
    #: Depth in which the gear was assembled [m].
    depth_m: float
    #: Distance from shore, where it was given [m].
    distance_m: float | None
    #: The day.
    on: str
    #: Every rule with its verdict, by pack.
    rules: list[RuleResult]
    #: Name and version of this form: `endline.rules.check/1`.
    schema: str
    #: Traps on one set: those given, else those counted.
    traps: int
    #: What no rule of the packs is about, in sentences, so that passes of other rules are not read as compliance.
    uncovered: list[str]


@dataclass(frozen=True)
class AreaOf(Record):
    """An area of which rules speak."""

    #: Id.
    area: str
    #: Name.
    name: str
    #: Area that it lies in; null where none holds it.
    within: str | None


@dataclass(frozen=True)
class Pack(Record):
    """A rule pack."""

    #: Its areas.
    areas: list[AreaOf]
    #: Id.
    id: str
    #: Whose rules they are.
    jurisdiction: str
    #: Name.
    name: str
    #: Notes.
    notes: str
    #: Its rules.
    rules: list[RuleOf]


@dataclass(frozen=True)
class ParameterOf(Record):
    """A number of a rule: as its pack has it, and in SI units."""

    #: How sure it is.
    confidence: str
    #: Its name in the expressions.
    parameter: str
    #: Source.
    source: str
    #: As the pack has it.
    text: str
    #: SI unit; empty for a number without one.
    unit: str
    #: In its SI unit.
    value: float


@dataclass(frozen=True)
class RuleOf(Record):
    """A rule as its pack has it; lengths in metres."""

    #: Areas in which it applies; empty for all.
    areas: list[str]
    #: The requirement in words.
    asks: str
    #: Whether it binds.
    binding: bool
    #: Expression that holds where the rule is kept.
    check: str
    #: Citation.
    cite: str
    #: How sure it is.
    confidence: str
    #: Least and greatest depth at which it applies [m].
    depth_m: list[float] | None
    #: Least and greatest distance from shore at which it applies [m].
    distance_m: list[float] | None
    #: First day in force.
    from_: str | None
    #: Notes.
    notes: str
    #: Numbers of the expressions.
    parameters: list[ParameterOf]
    #: How to make gear meet the rule, in words.
    remedy: str
    #: Id.
    rule: str
    #: First and last day of the year on which it applies.
    season: list[int] | None
    #: Source.
    source: str
    #: Whether it binds, is voluntary or was replaced, in a word.
    standing: str
    #: The part of the gear that it checks.
    subject: str
    #: Fewest and most traps of the gear to which it applies.
    traps: list[float] | None
    #: Last day in force; null where it still is.
    until: str | None
    #: Expression that decides to which of these it applies; null for all.
    when: str | None


@dataclass(frozen=True)
class RuleList(Record):
    """All packs."""

    #: The packs, in order of id.
    packs: list[Pack]
    #: Name and version of this form: `endline.rules.list/1`.
    schema: str


@dataclass(frozen=True)
class Along(Record):
    """Tension along the endline through the haul."""

    #: Places from the buoy, by unstretched rope [m].
    from_buoy_m: list[float]
    #: Rope taken in at each time [m].
    hauled_m: list[float]
    #: Angle of the line at the block from the vertical at each time [deg].
    lead_deg: list[float]
    #: Pull at the hauler at each time [N].
    load_N: list[float]
    #: Tension at each time and place; `null` where it is aboard [N].
    tension_N: list[list[float | None]]
    #: Times [s].
    time_s: list[float]


@dataclass(frozen=True)
class PartFactor(Record):
    """A factor of a budget."""

    #: How sure it is.
    confidence: str
    #: Its purpose.
    name: str
    #: Source.
    source: str
    #: The number.
    value: float


@dataclass(frozen=True)
class PartStrength(Record):
    """The strength of a piece of a line, of its weak places together, or of a weak link, with its factors."""

    #: How sure the least sure of its numbers is.
    confidence: str
    #: Mean strength delivered [N].
    delivered_N: float
    #: Strength of the piece that this run drew [N].
    drawn_N: float
    #: The factors by which it is reduced.
    factors: list[PartFactor]
    #: Coefficient of variation between gears of a fleet, beside that between pieces.
    fleet: Sourced | None
    #: The rope or weak link it is of, or the number and lengths of weak places.
    item: str
    #: The strengths between which nine pieces of ten lie [N].
    nine_of_ten_N: list[float]
    #: Its id in the model.
    part: str
    #: Strength as its source states it [N].
    stated: Sourced
    #: Coefficient of variation between pieces.
    variation: Sourced | None


@dataclass(frozen=True)
class Place(Record):
    """Where a part had the greatest share of its delivered strength."""

    #: Mean strength delivered there [N].
    delivered_N: float
    #: From the buoy along the endline, where it is on it [m].
    from_buoy_m: float | None
    #: Rope taken in by then [m].
    hauled_m: float
    #: Id of the piece of rope or link.
    part: str
    #: Probability that it parts.
    parts: float
    #: Tension [N].
    tension_N: float
    #: When [s].
    time_s: float
    #: Tension over that strength.
    used: float


@dataclass(frozen=True)
class Sourced(Record):
    """A number with where it comes from."""

    #: How sure it is.
    confidence: str
    #: Source.
    source: str
    #: The number.
    value: float


@dataclass(frozen=True)
class Stage(Record):
    """A stage of the haul: up to where something leaves the seabed or comes aboard."""

    #: Most traps and anchors that hung at once.
    hanging: int
    #: Rope taken in by then [m].
    hauled_m: float
    #: Greatest angle of the line at the block from the vertical [deg].
    lead_deg: float
    #: The place with the greatest share of its delivered strength.
    nearest: Place | None
    #: Probability that any part parts.
    parts: float
    #: Greatest pull at the hauler [N].
    peak_N: float
    #: When [s].
    time_s: float
    #: The event that ended it.
    until: str


@dataclass(frozen=True)
class HaulSheet(Record):
    """A haul as reported."""

    #: Tension along the endline through the haul.
    along: Along
    #: Id of the assembly.
    assembly: str
    #: Statics before the haul: `at rest`, or why not.
    before: str
    #: Height of the block over the sea surface [m].
    block_m: float
    #: Break-out over that of the traps' entries.
    break_out: float
    #: Depth [m].
    depth_m: float
    #: Most traps and anchors that hung off the seabed at once.
    hanging: int
    #: Rope taken in [m].
    hauled_m: float
    #: The place with the greatest share of its delivered strength.
    nearest: Place | None
    #: Probability that any part parts.
    parts: float
    #: Greatest pull at the hauler [N].
    peak_N: float
    #: Rope taken in by then [m].
    peak_hauled_m: float
    #: When [s].
    peak_s: float
    #: Their peak period [s].
    period_s: float | None
    #: Every piece of rope and link, by the share used of its delivered strength.
    places: list[Place]
    #: Name and version of this form: `endline.haul/1`.
    schema: str
    #: Significant height of the waves; zero in a calm [m].
    sea_m: float
    #: Id of the site.
    site: str
    #: Speed of the hauler [m/s].
    speed_m_s: float
    #: Stage by stage.
    stages: list[Stage]
    #: The delivered strength of each piece of rope and link, with its factors.
    strengths: list[PartStrength]
    #: Speed of the tide at its fastest height [m/s].
    tide_m_s: float
    #: Length of the haul [s].
    time_s: float
    #: Traps of the gear.
    traps: int
    #: Traps that came aboard.
    traps_aboard: int
    #: Solver steps that did not converge.
    unconverged: int
    #: Work of the hauler [J].
    work_J: float


@dataclass(frozen=True)
class HaulSweep(Record):
    """One haul of a table."""

    #: Statics before the haul.
    before: str
    #: Depth [m].
    depth_m: float
    #: Most traps and anchors that hung at once.
    hanging: int
    #: Part with the greatest share of its delivered strength.
    nearest: str
    #: Probability that any part parts.
    parts: float
    #: Greatest pull at the hauler [N].
    peak_N: float
    #: Tide [m/s].
    tide_m_s: float
    #: Traps.
    traps: int
    #: Tension there over mean delivered strength.
    used: float


@dataclass(frozen=True)
class Approval(Record):
    """One criterion of approval, or a limit."""

    #: Whether the mean of these breaks lies between.
    holds: bool
    #: Least mean of ten breaks that is approved [N].
    least_N: float
    #: Greatest mean of ten breaks that is approved [N].
    most_N: float
    #: Probability that one more break lies between; null without a deviation.
    one_probability: float | None
    #: Probability that the mean of ten more breaks of the product lies between; null without a deviation.
    probability: float | None
    #: Where it is published, or `--limit`.
    source: str


@dataclass(frozen=True)
class StrengthLaw(Record):
    """The strength law of a product, from its breaks."""

    #: The result of each criterion: the limits of the call, or the two of NOAA in the order of publication in docs/rules.md.
    approvals: list[Approval]
    #: Number of breaks.
    breaks: int
    #: Their standard deviation; null if it is unknown [N].
    deviation_N: float | None
    #: 95 % interval of the product's standard deviation; null without a deviation [N].
    deviation_interval_N: list[float] | None
    #: Their mean [N].
    mean_N: float
    #: 95 % interval of the product's mean; null without a deviation [N].
    mean_interval_N: list[float] | None
    #: Name of the sample in a table of means; empty otherwise.
    sample: str
    #: Name and version of this form: `endline.mill/1`.
    schema: str
    #: What cannot be concluded, in sentences; empty with a deviation.
    unknown: list[str]


@dataclass(frozen=True)
class MeansLaws(Record):
    """The laws of a table of means."""

    #: One for each row of the table.
    samples: list[StrengthLaw]
    #: Name and version of this form: `endline.mill.means/1`.
    schema: str
