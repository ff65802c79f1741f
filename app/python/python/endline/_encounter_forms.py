"""Results of commands, one dataclass for each object of their JSON. Written by `app/python/forms.py` from `endline schema`."""

from __future__ import annotations

from dataclasses import dataclass

from ._records import Record


@dataclass(frozen=True)
class Quantity(Record):
    """A quantity among the draws."""

    #: Among all draws.
    all: str
    #: Among the draws that end alike: the middle half, or words with their shares.
    like: str
    #: Its name; `first touched` for the part that rope touched first.
    name: str


@dataclass(frozen=True)
class Story(Record):
    """A story: an encounter, and how it ended."""

    #: Acts of the whale before and after the touch.
    acts: list[str]
    #: Share of its neighbours that end alike; `None` if none was run.
    alike: float | None
    #: Its direction relative to the current; empty if no heading is drawn.
    course: str
    #: Distance of its ending from the observation.
    distance: float
    #: Drawn values, by name.
    drawn: list[tuple[str, str]]
    #: Draws from the priors that are of this kind and like the observation.
    draws_like: int
    #: Distance of the same encounter on a finer resolution, 1000 for an invalid run; `None` if it was not run.
    finer: float | None
    #: The part that rope touched first.
    first_part: str
    #: Whether the mirror image of its ending is nearer to the observation.
    mirrored: bool
    #: Where in the unit cube of encounters.
    point: list[float]
    #: Simulated time of its run [s].
    simulated_s: float
    #: Hash of the last state.
    state_hash: str
    #: The terms of the distance, the greatest first, each with its reason.
    terms: list[tuple[float, str]]


@dataclass(frozen=True)
class Stories(Record):
    """The results of a search."""

    #: Id of the study whose encounters were searched.
    encounters: str
    #: Number of kinds whose nearest run ends with nothing on the whale; they are not listed.
    free_kinds: int
    #: Mean simulated time of the draws [s].
    mean_simulated_s: float
    #: Number of draws from the priors.
    net: int
    #: Draws that are like the observation. All draws have equal weight, so that this is the effective number.
    net_like: int
    #: Id of the observation.
    observation: str
    #: Every quantity among the draws like the observation, beside all draws; empty if too few are like it.
    posterior: list[Quantity]
    #: Name and version of this form: `endline.stories/1`.
    schema: str
    #: A run of every kind, in order of the least distance: the most robust of those like the observation, else the nearest.
    stories: list[Story]
    #: Trials run, neighbours not counted.
    trials: int


@dataclass(frozen=True)
class AssumedBand(Record):
    """Rates over the levels of assumed inputs, one input at a time."""

    #: Mean least and greatest rate with levels assigned at random.
    by_chance: Interval
    #: Greatest rate.
    greatest: float
    #: Input and level with the greatest rate.
    greatest_at: str
    #: Least rate.
    least: float
    #: Input and level with the least rate.
    least_at: str


@dataclass(frozen=True)
class Interval(Record):
    """An interval of 95 %."""

    #: Upper end.
    high: float
    #: Lower end.
    low: float


@dataclass(frozen=True)
class Rate(Record):
    """The rate of an event in the valid runs."""

    #: Its interval without that extension; the same for equal weights.
    as_met: Interval
    #: Number of encounters of equal weight that would give the same precision; `runs` for equal weights.
    effective: float
    #: Runs with the event.
    hits: int
    #: Its interval, extended for events that the study may have missed among encounters of large weight.
    interval: Interval
    #: Weighted share of the runs; 0 without runs.
    rate: float
    #: Valid runs.
    runs: int


@dataclass(frozen=True)
class Tau(Record):
    """Agreement in order."""

    #: Its interval of 95 % by chance; none where most samples have no order.
    interval: Interval | None
    #: Rows that both have.
    rows: int
    #: Kendall's τ_b.
    tau: float
    #: Pairs of rows that the simulation leaves in no order.
    ties: int


@dataclass(frozen=True)
class Threat(Record):
    """A row of the table."""

    #: Device in the endline.
    device: str
    #: Its diameter [in].
    diameter_in: float
    #: Id of the option that was simulated.
    option: str
    #: Least and greatest rate at the levels of the assumed inputs, where these vary.
    priors: AssumedBand | None
    #: Rate of the event, with its band of chance.
    rate: Rate
    #: Rope by the tool's name.
    rope: str
    #: Traps of the trawl.
    traps: int


@dataclass(frozen=True)
class Threats(Record):
    """The threat table of a study in the form of 2019."""

    #: Name of the event.
    event: str
    #: Hash of what defines its runs.
    hash: str
    #: By rope, device and traps.
    rows: list[Threat]
    #: Name and version of this form: `endline.threat/1`.
    schema: str
    #: Id of the study.
    study: str
    #: Agreement with the experts' table of 2019, if two rows are in common.
    tau: Tau | None


@dataclass(frozen=True)
class CappedTrawl(Record):
    """The mean threat of the lines of a trawl with a cap on strength."""

    #: Mean of NOAA's threat, with the bounds of the means of its three curves.
    noaa: ThreatRange
    #: Change of NOAA's threat, with the bounds of the changes of its three curves, each by itself.
    noaa_change: ThreatRange
    #: Mean simulated threat, with the means of the ends of its intervals of 95 %.
    simulated: ThreatRange
    #: Change of the simulated threat, -1 to 0 for a fall, with its interval of 95 % by chance; none where the event never
    #: occurs.
    simulated_change: ThreatRange | None


@dataclass(frozen=True)
class OptionThreat(Record):
    """The threat of an option with a strength."""

    #: Id of the option.
    option: str
    #: Least and greatest rate at the levels of the assumed inputs, where these vary.
    priors: AssumedBand | None
    #: Rate of the event, with its interval of 95 % by chance.
    rate: Rate
    #: Its strength [lbf].
    strength_lbf: float


@dataclass(frozen=True)
class RelativeThreat(Record):
    """Threats relative to those at the reference strength."""

    #: NOAA's threat over that at the reference, with the bounds of its three curves, each relative to itself.
    noaa: ThreatRange
    #: Whether the simulated interval and NOAA's bounds have a value in common.
    overlaps: bool
    #: Simulated threat over that at the reference, with its interval of 95 % by chance.
    simulated: ThreatRange


@dataclass(frozen=True)
class StrengthThreat(Record):
    """The threat at a strength of NOAA's table, simulated and NOAA's."""

    #: NOAA's threat, with the least and the greatest of its three curves as bounds.
    noaa: ThreatRange
    #: Origin of the simulated threat.
    origin: str
    #: Whether the simulated interval and NOAA's bounds have a value in common.
    overlaps: bool
    #: Least and greatest simulated threat at the levels of the assumed inputs; the threat itself where none varies.
    priors: Interval
    #: Both relative to their values at the reference strength; none where the simulated threat or NOAA's is 0 there.
    relative: RelativeThreat | None
    #: Valid runs of the option, or the lesser number of the two options between which it lies.
    runs: int
    #: Simulated threat, with its interval of 95 % by chance.
    simulated: ThreatRange
    #: Breaking strength [lbf].
    strength_lbf: float


@dataclass(frozen=True)
class ThreatRange(Record):
    """A threat with its bounds."""

    #: Lower bound.
    lower: float
    #: The threat, 0 to 1; for a relative threat, its share of that at the reference.
    threat: float
    #: Upper bound.
    upper: float


@dataclass(frozen=True)
class TrawlThreat(Record):
    """The mean threat of the lines of a trawl."""

    #: With the cap; none if no cap was given.
    capped: CappedTrawl | None
    #: Mean breaking strength of its lines in NOAA's distribution [lbf].
    mean_strength_lbf: float
    #: Mean of NOAA's threat, with the bounds of the means of its three curves.
    noaa: ThreatRange
    #: Mean simulated threat, with the means of the ends of its intervals of 95 %.
    simulated: ThreatRange
    #: Share of its lines stronger than the greatest simulated strength; they count with the rate at that strength.
    stronger_share: float
    #: Traps of the trawl.
    traps: int
    #: Share of its lines weaker than the least simulated strength; they count with the rate at that strength.
    weaker_share: float


@dataclass(frozen=True)
class StrengthThreats(Record):
    """The threat by breaking strength of a study, beside NOAA's."""

    #: Greatest strength of a line in the comparison by trawls [lbf]; none without a cap.
    cap_lbf: float | None
    #: Name of the curve; none for options that name no curve.
    curve: str | None
    #: Name of the event.
    event: str
    #: Hash of what defines its runs.
    hash: str
    #: Strengths of NOAA's table outside the simulated ones, which have no simulated threat [lbf].
    omitted_lbf: list[float]
    #: The simulated options, by strength.
    options: list[OptionThreat]
    #: The strength to which relative threats refer: the greatest simulated one within NOAA's table [lbf].
    reference_lbf: float
    #: Name and version of this form: `endline.threat_by_strength/1`.
    schema: str
    #: By the strengths of NOAA's table within the simulated ones.
    strengths: list[StrengthThreat]
    #: Id of the study.
    study: str
    #: Mean threats by traps of a trawl.
    trawls: list[TrawlThreat]
    #: Rate with rope that cannot part, if the study has such an option: the limit for great strength.
    unbreakable: Rate | None
