"""Random small domains: beasts that go about, and perhaps grip, push, tie and drain things."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Domain:
    """What there is of a domain, whose text is `text`.

    `paths` lead both ways. Beasts and things are `rests` at spots, or where they are `apart` beasts
    `stands` and things `lies`; `low` spots can be flooded; things may be tied to a raft, which
    is one of them. At `dusk` nobody goes anywhere. That a beast has to be where a thing is can be
    said in three `manners`.
    """

    spots: tuple[str, ...]
    paths: tuple[tuple[str, str], ...]
    things: tuple[str, ...]
    raft: str | None
    low: tuple[str, ...]
    apart: bool
    grips: bool
    pushes: bool
    single: bool
    dusk: bool = False
    manner: str = "apart"

    @property
    def nuts(self) -> tuple[str, ...]:
        """The things that are no raft."""
        return tuple(thing for thing in self.things if thing != self.raft)

    @property
    def of_beast(self) -> str:
        """The fluent that says where a beast is."""
        return "stands" if self.apart else "rests"

    @property
    def of_thing(self) -> str:
        """The fluent that says where a thing is."""
        return "lies" if self.apart else "rests"

    @property
    def text(self) -> str:
        """The AL_d text."""
        return "\n".join(
            f"{section}\n" + "\n".join(f"  {line}" for line in lines)
            for section, lines in self._sections()
            if lines
        )

    def _sections(self) -> Iterator[tuple[str, Sequence[str]]]:
        yield "sorts", list(self._sorts())
        yield "statics", ["path(spot, spot)."]
        yield "fluents", list(self._fluents())
        yield "actions", list(self._actions())
        yield "laws", [*self._effects(), *self._constraints(), *self._conditions()]
        yield "facts", [f"path({a}, {b})." for a, b in self.paths]
        yield "initially", list(self._initially())
        yield "sees", list(self._sees())
        yield "scenarios", ["1: nothing."]

    def _sorts(self) -> Iterator[str]:
        dry = [spot for spot in self.spots if spot not in self.low]
        if self.low:
            yield f"low = {{{', '.join(self.low)}}}."
            yield "spot = low" + (f" + {{{', '.join(dry)}}}." if dry else ".")
        else:
            yield f"spot = {{{', '.join(self.spots)}}}."
        yield "beast = {otter}."
        if self.raft:
            yield f"raft = {{{self.raft}}}."
            yield f"nut = {{{', '.join(self.nuts)}}}."
            yield "thing = nut + raft."
        else:
            yield f"thing = {{{', '.join(self.things)}}}."
        yield "body = beast + thing."

    def _fluents(self) -> Iterator[str]:
        if self.apart:
            yield "inertial stands(beast, spot)."
            yield "inertial lies(thing, spot)."
        else:
            yield "inertial rests(body, spot)."
        if self.grips:
            yield "inertial grips(beast, thing)."
        if self.raft:
            yield "inertial tied(nut, raft)."
        if self.low:
            yield "inertial flooded(low)."
        if self.dusk:
            yield "inertial dusk."
        if self.manner == "near":
            yield "defined near(beast, thing)."

    def _actions(self) -> Iterator[str]:
        yield "agent go(beast, spot)."
        if self.grips:
            yield "agent grip(beast, thing)."
            yield "agent drop(beast, thing)."
        if self.pushes:
            yield "agent push(beast, thing, spot)."
        if self.raft:
            yield "agent tie(beast, nut, raft)."
            yield "agent untie(beast, nut, raft)."
        if self.low:
            yield "agent drain(beast, low)."
            yield "exogenous rain(low)."
        if self.dusk:
            yield "agent kindle(beast)."
            yield "exogenous nightfall."
        yield "exogenous drift(thing, spot)."

    def _effects(self) -> Iterator[str]:
        here, there = self.of_beast, self.of_thing
        yield f"go(B, P) causes {here}(B, P)."
        if self.grips:
            yield "grip(B, T) causes grips(B, T)."
            yield "drop(B, T) causes -grips(B, T)."
        if self.pushes:
            yield f"push(B, T, P) causes {here}(B, P)."
            yield f"push(B, T, P) causes {there}(T, P)."
        if self.raft:
            yield "tie(B, N, R) causes tied(N, R)."
            yield "untie(B, N, R) causes -tied(N, R)."
            yield "drift(N, P) causes -tied(N, R)."
        if self.low:
            yield "drain(B, P) causes -flooded(P)."
            yield "rain(P) causes flooded(P)."
        if self.dusk:
            yield "kindle(B) causes -dusk."
            yield "nightfall causes dusk."
        yield f"drift(T, P) causes {there}(T, P)."

    def _constraints(self) -> Iterator[str]:
        here, there = self.of_beast, self.of_thing
        yield "path(A, B) if path(B, A)."
        for fluent in dict.fromkeys((here, there)):
            yield f"-{fluent}(X, P2) if {fluent}(X, P1), P1 != P2."
        if self.grips:
            yield f"{there}(T, P) if {here}(B, P), grips(B, T)."
            if self.single:
                yield "-grips(B, T1) if grips(B, T2), T1 != T2."
        if self.raft:
            yield f"{there}(N, P) if {there}(R, P), tied(N, R)."
        if self.manner == "near":
            yield f"near(B, T) if {here}(B, P), {there}(T, P)."

    def _conditions(self) -> Iterator[str]:
        here, there = self.of_beast, self.of_thing
        apart = {
            "apart": f"{here}(B, P1), {there}(T, P2), P1 != P2",
            "near": "-near(B, T)",
            "denied": f"{here}(B, P), -{there}(T, P)",
        }[self.manner]
        for action in ("go(B, P)", *(["push(B, T, P)"] if self.pushes else [])):
            yield f"impossible {action} if {here}(B, P)."
            yield f"impossible {action} if {here}(B, A), -path(A, P)."
            if self.dusk:
                yield f"impossible {action} if dusk."
            if self.low:
                yield f"impossible {action} if flooded(P)."
                yield f"impossible {action} if {here}(B, A), flooded(A)."
        if self.grips:
            yield f"impossible grip(B, T) if {apart}."
            yield "impossible grip(B, T) if grips(B, T)."
            if self.single:
                yield "impossible grip(B, T) if grips(B, T2)."
            if self.raft:
                yield "impossible grip(B, N) if tied(N, R)."
                yield "impossible tie(B, N, R) if grips(B, N)."
            yield "impossible drop(B, T) if -grips(B, T)."
            yield "impossible drift(T, P) if grips(B, T)."
        if self.pushes:
            yield f"impossible push(B, T, Q) if {apart}."
            if self.grips:
                yield "impossible push(B, T, P) if grips(B, T2)."
            if self.raft:
                yield "impossible push(B, N, P) if tied(N, R)."
        if self.raft:
            for action in ("tie(B, N, R)", "untie(B, N, R)"):
                yield f"impossible {action} if {here}(B, P1), {there}(R, P2), P1 != P2."
            yield f"impossible tie(B, N, R) if {there}(N, P1), {there}(R, P2), P1 != P2."
            yield "impossible tie(B, N, R) if tied(N, R)."
            yield "impossible untie(B, N, R) if -tied(N, R)."
        if self.low:
            yield "impossible drain(B, P) if -flooded(P)."
            yield f"impossible drain(B, P) if {here}(B, A), -path(A, P), A != P."
            yield "impossible rain(P) if flooded(P)."
        if self.dusk:
            yield "impossible kindle(B) if -dusk."
            yield "impossible nightfall if dusk."
        yield f"impossible drift(T, P) if {there}(T, P)."

    def _initially(self) -> Iterator[str]:
        for fluent in dict.fromkeys((self.of_beast, self.of_thing)):
            yield f"{fluent}(X, P) for some P."

    def _sees(self) -> Iterator[str]:
        here, there = self.of_beast, self.of_thing
        yield f"B sees {here}(B, P) if beast(B)."
        yield f"B sees {there}(T, P) if thing(T), {here}(B, P)."
        if self.grips:
            yield "B sees grips(B, T)."
        if self.raft:
            yield f"B sees tied(N, R) if {here}(B, P), {there}(R, P)."
        if self.low:
            yield f"B sees flooded(P) if {here}(B, P)."
            yield f"B sees flooded(P) if {here}(B, A), path(A, P)."
        if self.dusk:
            yield "B sees dusk if beast(B)."
