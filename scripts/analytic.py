#!/usr/bin/env python3
"""Exact solutions of impact of elastic bars (1-D waves, no friction), and of layers that meet
obliquely with Coulomb friction.

Symbols and dimensions: L length [L], c wave speed [L T-1], rho density [M L-3], A section [L2],
Z = rho c A impedance [M T-1], v velocity [L T-1], N axial force, tension positive [F],
F contact force, compression positive [F], t time [T].

Waves: v - N/Z travels to the right, v + N/Z to the left, each unchanged (d'Alembert 1747;
Graff 1975, Wave Motion in Elastic Solids; Goldsmith 1960, Impact).

    TwoBars         closed form: two identical bars at +v0 and -v0, or one bar on a rigid wall
    Impact          any two bars, by characteristics: force, displacements, energies, fields
    Oblique         two layers, half spaces or a wall: plane P and S waves, stick or slip
    Hertz, Westergaard, punch_force: pressure of bodies that are pressed together
    unequal_lengths, staircase, interface, touch_time: closed forms
    mass_on_rod     a rigid mass that strikes a rod
    press_fit       bars that are pushed together: overlap, or a gap that is closed
    StickSlip       a block on a belt, held by a spring
    disc_impact, three_in_a_row: impacts of rigid bodies
    GlidingBlock    a block on its two lower corners in a smooth bowl
    Belt            a block on a belt
"""

import argparse
import bisect
import sys
from dataclasses import dataclass

import startup  # noqa: F401  before what is no part of Python
import numpy as np

# ---------------------------------------------------------------- closed forms


def touch_time(gap, v1, v2):
    """t1 = gap/(v1 - v2) [T] of two bodies that close a gap [L]; inf if they do not close."""
    if gap <= 0.0 < v1 - v2:
        return 0.0
    return gap / (v1 - v2) if v1 > v2 else float("inf")


def interface(z1, z2, v1, v2):
    """Velocity [L T-1] and force [F] of two free faces at v1, v2 that meet:
    v = (Z1 v1 + Z2 v2)/(Z1 + Z2),  F = Z1 Z2/(Z1 + Z2) (v1 - v2)   (Goldsmith 1960)."""
    return (z1 * v1 + z2 * v2) / (z1 + z2), z1 * z2 / (z1 + z2) * (v1 - v2)


def unequal_lengths(length1, length2, speed, impedance, velocity):
    """Bar 1 at `velocity` strikes bar 2 at rest; same Z and c, length1 < length2.

    F = Z V/2 during 2 L1/c; then bar 1 rests without stress and the centre of bar 2 moves at
    V L1/L2; restitution e = L1/L2; share 1 - L1/L2 of the energy stays as vibration of bar 2
    (Goldsmith 1960).  Until 2 L2/c the bars still touch, at zero force.
    """
    ratio = length1 / length2
    return {
        "force": 0.5 * impedance * velocity,
        "duration": 2.0 * length1 / speed,
        "v_cm1": 0.0,
        "v_cm2": velocity * ratio,
        "restitution": ratio,
        "vibration_share": 1.0 - ratio,
    }


def staircase(z1, z2, velocity, k):
    """Contact force on the k-th interval (k = 0, 1, ...) of length 2 L1/c1; bar 2 very long and
    at rest:  F_k = F_0 ((Z1 - Z2)/(Z1 + Z2))^k,  F_0 = Z1 Z2/(Z1 + Z2) V;  zero for k > 0 if
    Z1 <= Z2 (then bar 1 has rebounded).  Goldsmith 1960."""
    first = interface(z1, z2, velocity, 0.0)[1]
    ratio = (z1 - z2) / (z1 + z2)
    return first * np.where(np.asarray(k) == 0, 1.0, max(ratio, 0.0) ** np.asarray(k, float))


@dataclass(frozen=True)
class TwoBars:
    """Two identical bars meet at +v0 and -v0 (Armero and Petocz 1998 use the same test).

    touch t1 = gap/(2 v0); release t2 = t1 + 2 L/c; stress rho c v0 in between.  The default
    data are ours for the paper's test: gap 0.02, v0 1.  bars = 1 is the left bar on a rigid
    wall at distance gap: t1 = gap/v0, half of the energy.  The bar lies on -L < x < 0.
    """

    length: float = 10.0  # [L]
    speed: float = 1000.0  # [L T-1]
    density: float = 1.0e-3  # [M L-3]
    area: float = 1.0  # [L2]
    v0: float = 1.0  # [L T-1]
    gap: float = 0.02  # [L]
    bars: int = 2

    @property
    def touch(self):
        """t1 [T]"""
        return self.gap / (self.bars * self.v0)

    @property
    def release(self):
        """t2 [T]"""
        return self.touch + 2.0 * self.length / self.speed

    @property
    def energy(self):
        """Energy of all bars, rho L A v0^2/2 each [F L]"""
        return 0.5 * self.bars * self.density * self.length * self.area * self.v0**2

    @property
    def impulse(self):
        """2 rho L A v0 [F T]"""
        return 2.0 * self.density * self.length * self.area * self.v0

    def tip(self, t):
        """Displacement of the left bar's contact end [L]: up, held, back."""
        before = np.minimum(t, self.touch)
        return self.v0 * (before - np.maximum(np.asarray(t) - self.release, 0.0))

    def in_contact(self, t):
        """True for t1 < t < t2."""
        return (np.asarray(t) > self.touch) & (np.asarray(t) < self.release)

    def force(self, t):
        """Contact force rho c v0 A between touch and release [F]."""
        return self.density * self.speed * self.v0 * self.area * self.in_contact(t)

    def progress(self, t):
        """tau c/L of the contact time, 0 at the touch and 2 at the release [-]."""
        phase = (np.asarray(t) - self.touch) * self.speed / self.length
        return np.clip(phase, 0.0, 2.0)

    def kinetic(self, t):
        """KE = E0 |1 - c tau/L| [F L]"""
        return self.energy * np.abs(1.0 - self.progress(t))

    def strain(self, t):
        """SE = E0 - KE [F L]"""
        return self.energy - self.kinetic(t)

    def mean_velocity(self, t):
        """Velocity of the left bar's centre of mass, v0 (1 - c tau/L) [L T-1]"""
        return self.v0 * (1.0 - self.progress(t))

    def velocity(self, x, t):
        """Velocity of the left bar at -L < x < 0 [L T-1]: v0, 0 behind the loading wave, -v0
        behind the unloading wave."""
        depth, phase = -np.asarray(x) / self.length, self.progress(t)
        loaded, unloaded = depth < phase, depth > 2.0 - phase
        return self.v0 * np.where(unloaded, -1.0, np.where(loaded, 0.0, 1.0))

    def stress(self, x, t):
        """Axial stress of the left bar, tension positive [F L-2]: -rho c v0 where v = 0."""
        held = self.velocity(x, t) == 0.0
        return -self.density * self.speed * self.v0 * held


# ---------------------------------------------------------------- characteristics


@dataclass(frozen=True)
class Bar:
    """A uniform bar without stress at uniform velocity."""

    length: float  # [L]
    speed: float  # [L T-1]
    impedance: float  # [M T-1]
    velocity: float  # [L T-1]

    @property
    def line_mass(self):
        """rho A = Z/c [M L-1]"""
        return self.impedance / self.speed

    @property
    def mass(self):
        """rho A L [M]"""
        return self.line_mass * self.length

    @property
    def round_trip(self):
        """2 L/c [T]"""
        return 2.0 * self.length / self.speed


class Wave:
    """Piecewise constant wave that leaves the interface into one bar, as a function of the time
    of departure [T]; before t = 0 it is the bar's initial velocity [L T-1]."""

    def __init__(self, initial, tolerance):
        self.times, self.values, self.tolerance = [float("-inf")], [initial], tolerance

    def append(self, time, value):
        """From `time` on the wave has this value."""
        if value != self.values[-1]:
            self.times.append(time)
            self.values.append(value)

    def at(self, time):
        """Value just after `time`."""
        return self.values[bisect.bisect_right(self.times, time + self.tolerance) - 1]

    def next_change(self, time):
        """First change after `time`; inf if none is known."""
        k = bisect.bisect_right(self.times, time + self.tolerance)
        return self.times[k] if k < len(self.times) else float("inf")


class Impact:
    """Exact impact of two bars that face each other across a gap; no stress at the far ends.

    Method of characteristics with events instead of a fixed grid, so that any lengths, speeds
    and gaps are exact.  With h = c dt in each bar it is the grid solution (Courant number 1;
    Courant, Friedrichs and Lewy 1928).  A wave a_i that leaves the interface into bar i returns
    after 2 L_i/c_i, reflected at the free end, and the interface then has
        closed: F = Z1 Z2/(Z1 + Z2) (a_1' - a_2'), kept while F >= 0, no tension
        open:   F = 0, v_i = a_i',  gap grows by v_2 - v_1
    with a_i' the returning wave; the new one is a_1 = v_1 - F/Z1, a_2 = v_2 + F/Z2.

    times [T]   m + 1 ends of the intervals on which everything at the interface is constant
    force [F], v1, v2 [L T-1]   the m values: contact force, velocities of the two contact ends
    """

    def __init__(self, bar1, bar2, gap, tend):
        self.bars, self.gap, self.tend = (bar1, bar2), gap, tend
        tolerance = 1e-12 * max(bar1.round_trip, bar2.round_trip, tend)
        self.waves = Wave(bar1.velocity, tolerance), Wave(bar2.velocity, tolerance)
        self._march()
        span = np.diff(self.times)
        self._u1, self._u2, self._impulse = (
            np.concatenate(([0.0], np.cumsum(rate * span)))
            for rate in (self.v1, self.v2, self.force_steps)
        )

    def _march(self):
        """March from event to event and keep the interface values."""
        t, gap, rows = 0.0, self.gap, []
        while t < self.tend:
            force, v1, v2, closed = self._interface(t, gap)
            rows.append((t, force, v1, v2))
            self._emit(t, force, v1, v2)
            t_next = self._next_event(t)
            closing = t + gap / (v1 - v2) if not closed and v1 > v2 else float("inf")
            if closed or closing <= t_next:
                gap, t = 0.0, min(t_next, closing)
            else:
                gap, t = gap + (v2 - v1) * (t_next - t), t_next
        starts, self.force_steps, self.v1, self.v2 = np.array(rows).T
        self.times = np.append(starts, self.tend)

    def _interface(self, t, gap):
        """Force, end velocities and status just after t; round-off of the force is no force."""
        bar1, bar2 = self.bars
        back1 = self.waves[0].at(t - bar1.round_trip)
        back2 = self.waves[1].at(t - bar2.round_trip)
        common, force = interface(bar1.impedance, bar2.impedance, back1, back2)
        speed = abs(bar1.velocity - bar2.velocity)
        if abs(force) <= 1e-13 * interface(bar1.impedance, bar2.impedance, speed, 0.0)[1]:
            return 0.0, back1, back2, gap <= 0.0
        if gap <= 0.0 and force > 0.0:
            return force, common, common, True
        return 0.0, back1, back2, False

    def _emit(self, t, force, v1, v2):
        """Waves that leave the interface at t."""
        self.waves[0].append(t, v1 - force / self.bars[0].impedance)
        self.waves[1].append(t, v2 + force / self.bars[1].impedance)

    def _next_event(self, t):
        """Time of the next returning change, at most the end."""
        returns = [
            wave.next_change(t - bar.round_trip) + bar.round_trip
            for bar, wave in zip(self.bars, self.waves)
        ]
        return min(self.tend, *returns)

    # ---- results, for numbers or arrays of times [T]

    def displacement(self, t):
        """Displacements of the two contact ends [L]."""
        return np.interp(t, self.times, self._u1), np.interp(t, self.times, self._u2)

    def tip(self, t):
        """Displacement of the contact end of bar 1 [L]."""
        return np.interp(t, self.times, self._u1)

    def impulse(self, t):
        """Impulse of the contact force since t = 0 [F T]."""
        return np.interp(t, self.times, self._impulse)

    def force(self, t):
        """Contact force just after t [F]."""
        k = np.searchsorted(self.times, t, side="right") - 1
        return self.force_steps[np.clip(k, 0, len(self.force_steps) - 1)]

    def mean_force(self, start, end):
        """Mean contact force over intervals [F]: impulse over duration."""
        return (self.impulse(end) - self.impulse(start)) / (np.asarray(end) - start)

    def step_forces(self, dt, steps):
        """Mean force of each of the steps ((k - 1) dt, k dt], k = 1..steps [F]."""
        t = dt * np.arange(steps + 1)
        return self.mean_force(t[:-1], t[1:])

    @property
    def touch(self):
        """Time of the first touch [T]."""
        return touch_time(self.gap, self.bars[0].velocity, self.bars[1].velocity)

    @property
    def release(self):
        """End of the last interval with force [T]; inf if there was no contact."""
        loaded = np.flatnonzero(self.force_steps > 0.0)
        return self.times[loaded[-1] + 1] if loaded.size else float("inf")

    @property
    def momentum_scale(self):
        """sum m |v| at the start [M L T-1]"""
        return sum(bar.mass * abs(bar.velocity) for bar in self.bars)

    @property
    def energy(self):
        """Energy at the start, sum m v^2/2 [F L]"""
        return sum(0.5 * bar.mass * bar.velocity**2 for bar in self.bars)

    def mean_velocities(self, t):
        """Velocities of the centres of mass [L T-1]: v_i -+ impulse/m_i."""
        bar1, bar2 = self.bars
        return (
            bar1.velocity - self.impulse(t) / bar1.mass,
            bar2.velocity + self.impulse(t) / bar2.mass,
        )

    def _leaving_and_returning(self, i, y, t):
        """The two waves of bar i at distance y from the contact end: the one that left the
        interface at t - y/c and the one that will be back at t + y/c."""
        bar, wave = self.bars[i], self.waves[i]
        leaving = wave.at(t - y / bar.speed)
        return leaving, wave.at(t + y / bar.speed - bar.round_trip)

    def field(self, i, y, t):
        """Velocity [L T-1] and axial force (tension positive) [F] of bar i = 0, 1 at distance
        y from its contact end:  v = (a + b)/2, N = Z (a - b)/2 with the sign of the side."""
        leaving, back = self._leaving_and_returning(i, y, t)
        sign = 1.0 if i == 0 else -1.0
        return 0.5 * (leaving + back), sign * 0.5 * self.bars[i].impedance * (leaving - back)

    def _bar_energies(self, i, t):
        """Kinetic and strain energy of bar i at one time [F L], exact:
        KE = rho A/8 int (a + b)^2 dy, SE = rho A/8 int (a - b)^2 dy."""
        bar, wave = self.bars[i], self.waves[i]
        change = np.array(wave.times[1:])
        cuts = np.concatenate(
            (
                [0.0, bar.length],
                bar.speed * (t - change),
                bar.speed * (change - t + bar.round_trip),
            )
        )
        cuts = np.unique(cuts[(cuts >= 0.0) & (cuts <= bar.length)])
        pairs = [self._leaving_and_returning(i, y, t) for y in 0.5 * (cuts[:-1] + cuts[1:])]
        a, b = np.array(pairs).T
        weight = 0.125 * bar.line_mass * np.diff(cuts)
        return np.sum(weight * (a + b) ** 2), np.sum(weight * (a - b) ** 2)

    def energies(self, t):
        """Kinetic and strain energy of both bars [F L]."""
        values = [
            np.add(self._bar_energies(0, s), self._bar_energies(1, s)) for s in np.atleast_1d(t)
        ]
        kinetic, strain = np.array(values).T
        return (kinetic, strain) if np.ndim(t) else (kinetic[0], strain[0])


def wall_impact(bar, gap, tend):
    """Bar on a rigid wall at distance gap: the same as its mirror image at twice the gap."""
    image = Bar(bar.length, bar.speed, bar.impedance, -bar.velocity)
    return Impact(bar, image, 2.0 * gap, tend)


def impact_of(meta, tend=None):
    """Exact solution of the scene that make_bars.py describes (its dictionary or json)."""
    bars = [Bar(b["length"], b["speed"], b["impedance"], b["velocity"]) for b in meta["bars"]]
    tend = meta["tend"] if tend is None else tend
    if meta["case"] == "wall":
        return wall_impact(bars[0], meta["gap"], tend)
    return Impact(bars[0], bars[1], meta["gap"], tend)


# ---------------------------------------------------------------- oblique impact


@dataclass(frozen=True)
class Layer:
    """A plane layer that moves as one, its free back face parallel to its contact face.

    P and S waves of normal incidence travel through it independently: a face without traction
    would move at w(t) = w(t - T) - 2 F(t - T)/Z, F the traction on the body at its face,
    T = 2 L/c the time of a return (d'Alembert); a half space has L infinite."""

    pressure_impedance: float  # rho c_p [M L-2 T-1]
    shear_impedance: float  # rho c_s
    normal: float  # velocity toward the other body [L T-1]
    tangential: float
    pressure_return: float = float("inf")  # 2 L/c_p [T]
    shear_return: float = float("inf")  # 2 L/c_s


class Oblique:
    """A layer on a rigid wall or on another layer, gap 0 at t = 0, Coulomb friction.

    With Z* = Z_A Z_B/(Z_A + Z_B), or Z_A on a wall: p = max(0, Z_p* w_n), tau = Z_s* w_t cut to
    mu p, w relative and without traction. First instant: it sticks where Z_s* |V_t| <= mu Z_p*
    V_n. Valid as long as the faces have not parted and come back."""

    def __init__(self, layer, mu, other=None):
        self.layer, self.mu, self.other = layer, mu, other

    def _untouched(self, t, body, normal):
        """Velocity of a face without traction from now on; towards the other body (normal), or
        along A's direction of slip [L T-1]."""
        z, back = (
            (body.pressure_impedance, body.pressure_return)
            if normal
            else (body.shear_impedance, body.shear_return)
        )
        if t < back:
            return body.normal if normal else body.tangential
        force = self.traction(t - back)[0 if normal else 1]
        sign = 1.0 if normal or body is self.layer else -1.0
        return self._untouched(t - back, body, normal) - 2.0 * sign * force / z

    def _pair(self, t, normal):
        """(relative velocity without traction, Z*) of one direction."""
        a, b = self.layer, self.other
        z = a.pressure_impedance if normal else a.shear_impedance
        w = self._untouched(t, a, normal)
        if b is not None:
            z2 = b.pressure_impedance if normal else b.shear_impedance
            other = self._untouched(t, b, normal)
            w += other if normal else -other
            z = z * z2 / (z + z2)
        return w, z

    def traction(self, t):
        """(p, tau) [F L-2] at a time t >= 0: pressure, and friction against the motion of A."""
        w, z = self._pair(t, True)
        p = max(0.0, z * w)
        w, z = self._pair(t, False)
        return p, min(max(z * w, -self.mu * p), self.mu * p)

    def slip(self, t):
        """Speed of A's face along B's [L T-1]."""
        w, z = self._pair(t, False)
        return w - self.traction(t)[1] / z


# ---------------------------------------------------------------- gravity, friction


@dataclass(frozen=True)
class BouncingBar:
    """An elastic bar falls on a rigid wall under gravity and bounces for ever (Doyen, Ern &
    Piperno 2011; here in closed form for the data where tf = 3 L/c).

    At t = 0 it is without stress and at rest, its lower end at height h0 = g tf^2/2.  One
    period: fall tf, contact 2 L/c, flight 2 tf, contact 2 L/c, rise tf; total energy rho g L h0
    A."""

    length: float = 10.0  # [L]
    young: float = 900.0  # [F L-2]
    density: float = 1.0  # [M L-3]
    gravity: float = 10.0  # [L T-2]
    area: float = 1.0  # [L2]
    falls: float = 3.0  # tf c/L, a whole number

    @property
    def speed(self):
        """c [L T-1]"""
        return float(np.sqrt(self.young / self.density))

    @property
    def transit(self):
        """L/c [T]"""
        return self.length / self.speed

    @property
    def fall(self):
        """tf [T]"""
        return self.falls * self.transit

    @property
    def height(self):
        """h0 [L]"""
        return 0.5 * self.gravity * self.fall**2

    @property
    def period(self):
        """4 tf + 4 L/c [T]"""
        return 4.0 * self.fall + 4.0 * self.transit

    @property
    def energy(self):
        """Kinetic energy at the touch [F L]"""
        return self.density * self.gravity * self.length * self.height * self.area

    def _phases(self, t):
        """Time within the period and the times where its parts begin."""
        t1 = self.fall
        t2 = t1 + 2.0 * self.transit
        t3 = t2 + 2.0 * self.fall
        return np.mod(t, self.period), t1, t2, t3, t3 + 2.0 * self.transit

    def bottom(self, t):
        """Height of the lower end over the wall [L]."""
        s, t1, t2, t3, t4 = self._phases(t)
        g, c, speed = self.gravity, self.speed, self.gravity * self.fall
        wave = np.mod(c * (s - t2), 2.0 * self.length)
        flight = (
            speed * (s - t2)
            - 0.5 * g * (s - t2) ** 2
            - 2.0 * g / c**2 * (self.length * wave - 0.5 * wave**2)
        )
        rise = speed * (s - t4) - 0.5 * g * (s - t4) ** 2
        return np.select(
            [s < t1, s < t2, s < t3, s < t4],
            [self.height - 0.5 * g * s**2, 0.0 * s, flight, 0.0 * s],
            rise,
        )

    def force(self, t):
        """Contact force [F]: rho c (vf + g (t - t1)) in the first contact, falling in the
        second."""
        s, t1, t2, t3, t4 = self._phases(t)
        unit = self.density * self.speed * self.area
        speed = self.gravity * self.fall
        return unit * np.select(
            [s < t1, s < t2, s < t3, s < t4],
            [
                0.0 * s,
                speed + self.gravity * (s - t1),
                0.0 * s,
                speed + self.gravity * (t4 - s),
            ],
            0.0 * s,
        )


@dataclass(frozen=True)
class SlidingBlock:
    """A rigid block that slides on a plane at v0, friction mu, gravity g (Coulomb)."""

    v0: float = 1.0  # [L T-1]
    mu: float = 0.2
    gravity: float = 10.0  # [L T-2]
    mass: float = 1.0  # [M]

    @property
    def stop(self):
        """Time when it stops, v0/(mu g) [T]"""
        return self.v0 / (self.mu * self.gravity)

    def place(self, t):
        """Distance from the start [L]."""
        s = np.minimum(t, self.stop)
        return self.v0 * s - 0.5 * self.mu * self.gravity * s**2

    def friction_work(self, t):
        """mu m g times the distance [F L]"""
        return self.mu * self.mass * self.gravity * self.place(t)


def press_fit(overlap, lengths, moduli):
    """Pressure [F L-2] between two bars (lengths [L], moduli [F L-2]) held at their far ends
    whose meeting ends overlap by so much [L]: p = overlap/(L1/E1 + L2/E2). The same where an
    end is pushed through a gap (Signorini 1933): the overlap is the way less the gap."""
    return overlap / sum(length / modulus for length, modulus in zip(lengths, moduli))


@dataclass
class StickSlip:
    """A block on a moving belt, held by a spring: it sticks until the spring pulls with
    mu_s N, then slips against mu_k N until it has the velocity of the belt again. With
    w = sqrt(k/m) and A = (mu_s - mu_k) N/k the slip is x_k + A cos wt + (V/w) sin wt
    (Den Hartog 1956, Mechanical Vibrations)."""

    belt: float = 0.01  # velocity V [L T-1]
    stiffness: float = 1.0  # k [F L-1]
    mass: float = 1.0  # [M]
    normal: float = 0.1  # N [F]
    static: float = 0.4
    kinetic: float = 0.2

    @property
    def frequency(self):
        """w [T-1]"""
        return np.sqrt(self.stiffness / self.mass)

    @property
    def excess(self):
        """A [L]"""
        return (self.static - self.kinetic) * self.normal / self.stiffness

    @property
    def stick(self):
        """Time of sticking [T]: the spring goes from x_k - A to x_k + A."""
        return 2.0 * self.excess / self.belt

    @property
    def slip(self):
        """Time of slipping [T]"""
        w = self.frequency
        return (2.0 * np.pi - 2.0 * np.arctan(self.excess * w / self.belt)) / w

    @property
    def period(self):
        return self.stick + self.slip


def mass_on_rod(impedance, mass, velocity, t):
    """Force [F] of a rigid mass that strikes the end of a rod at rest: Z V exp(-Z t/M), until
    the wave comes back from the other end at 2 L/c (Saint-Venant 1883; Goldsmith 1960)."""
    return impedance * velocity * np.exp(-impedance * np.asarray(t) / mass)


# ---------------------------------------------------------------- rigid bodies


def disc_impact(radius, gyration2, mu, rest, vt, vn):
    """(v_t, v_n, spin) after the impact of a rigid disc whose lowest point meets a plane at vt
    along and vn towards it [L T-1], no spin before. R radius [L], k^2 = J/m [L2], kappa = 1 +
    R^2/k^2. It slips throughout where |vt| >= mu kappa vn, the impulse then being mu (1 + e) m
    vn; else it sticks and its point leaves with -e vt: restitution in both directions (Routh
    1905, Dynamics of a System of Rigid Bodies I; the law is that of Moreau 1988)."""
    kappa = 1.0 + radius**2 / gyration2
    if abs(vt) >= mu * kappa * vn:
        jump = -np.copysign(mu * (1.0 + rest) * vn, vt)
    else:
        jump = -(1.0 + rest) * vt / kappa
    return vt + jump, rest * vn, jump * radius / gyration2


def three_in_a_row(rest, velocity=1.0):
    """Velocities of three equal rigid bodies, the first of which arrives at the other two that
    touch: both contacts take part in one impact (Moreau 1988, Unilateral contact and dry
    friction in finite freedom dynamics)."""
    third = (1.0 + rest) * velocity / 3.0
    return velocity - 2.0 * third, third, third


@dataclass(frozen=True)
class GlidingBlock:
    """A stiff block that glides without friction on its two lower corners in a bowl.

    It turns about the centre of the bowl, with the inertia I about it. Its corners are at depth
    d = sqrt(R^2 - a^2). A rigid body has its centre raised by (d - H/2) phi^2/2; in the
    kinematics of small displacements a turn is phi e_z x X, which makes the block larger, and
    the corners stay on the circle when it is raised by R^2 phi^2/(2 d) as a whole."""

    radius: float = 2.0  # R [L]
    half_width: float = 0.5  # a
    height: float = 0.4  # H
    gravity: float = 10.0  # [L T-2]

    @property
    def depth(self):
        """d [L]"""
        return float(np.sqrt(self.radius**2 - self.half_width**2))

    @property
    def inertia(self):
        """I/m about the centre of the bowl [L2]"""
        arm = self.depth - 0.5 * self.height
        return (4.0 * self.half_width**2 + self.height**2) / 12.0 + arm**2

    def period(self, small_displacements=True, swing=0.0):
        """[T] of small swings; without the kinematics of small displacements that of the
        physical pendulum with an amplitude `swing` [rad], by the arithmetic-geometric mean
        (Gauss)."""
        raised = self.radius**2 / self.depth
        one, other = 1.0, 1.0
        if not small_displacements:
            raised = self.depth - 0.5 * self.height
            other = np.cos(0.5 * swing)
            while abs(one - other) > 1.0e-15:
                one, other = 0.5 * (one + other), np.sqrt(one * other)
        return float(2.0 * np.pi * np.sqrt(self.inertia / (self.gravity * raised)) / one)


@dataclass(frozen=True)
class Belt:
    """A rigid block at rest on a belt that runs at V: friction mu m g drives it until it has
    the velocity of the belt, at V/(mu g) (Coulomb)."""

    speed: float = 1.0  # V [L T-1]
    mu: float = 0.2
    gravity: float = 10.0  # [L T-2]
    mass: float = 1.0  # [M]

    @property
    def catch(self):
        """Time when the block sticks [T]"""
        return self.speed / (self.mu * self.gravity)

    def velocity(self, t):
        """Of the block [L T-1]."""
        return np.minimum(self.mu * self.gravity * np.asarray(t), self.speed)

    def friction_work(self, t):
        """mu m g times the slip [F L]; m V^2/2 in the end, as much as the block has."""
        s = np.minimum(t, self.catch)
        slip = self.speed * s - 0.5 * self.mu * self.gravity * s**2
        return self.mu * self.mass * self.gravity * slip

    def belt_work(self, t):
        """mu m g times the way of the belt [F L]."""
        return self.mu * self.mass * self.gravity * self.speed * np.minimum(t, self.catch)


# ---------------------------------------------------------------- static contact


@dataclass(frozen=True)
class Hertz:
    """Two cylinders in plane strain (Hertz 1882; Johnson 1985, Contact Mechanics, 4.2 and 7.2):
    1/R = 1/R1 + 1/R2, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, load P per length."""

    radius: float  # R [L]
    modulus: float  # E* [F L-2]
    load: float  # P [F L-1]

    @property
    def half_width(self):
        """b = 2 sqrt(P R/(pi E*)) [L]"""
        return 2.0 * np.sqrt(self.load * self.radius / (np.pi * self.modulus))

    @property
    def largest(self):
        """p0 = 2 P/(pi b) [F L-2]"""
        return 2.0 * self.load / (np.pi * self.half_width)

    def pressure(self, x):
        """p0 sqrt(1 - x^2/b^2)"""
        return self.largest * np.sqrt(np.maximum(0.0, 1.0 - (x / self.half_width) ** 2))

    def shear(self, x, mu, force):
        """Of bodies with equal constants under a tangential force Q < mu P per length (Cattaneo
        1938, Mindlin 1949): mu p less the same ellipse on the part c that sticks, c/b =
        sqrt(1 - Q/(mu P)), times c/b."""
        share = np.sqrt(1.0 - force / (mu * self.load))
        stick = share * self.half_width
        inner = np.sqrt(np.maximum(0.0, 1.0 - (x / stick) ** 2))
        return mu * (self.pressure(x) - share * self.largest * inner)


@dataclass(frozen=True)
class Westergaard:
    """A wave of amplitude D and length l pressed on a flat face by a mean pressure below that
    of full contact, p* = pi E* D/l, D half of its height (Westergaard 1939; Johnson 1985,
    13.2)."""

    wave: float  # l [L]
    full: float  # p* [F L-2]
    mean: float  # [F L-2]

    @property
    def half_width(self):
        """a: sin^2(pi a/l) = mean/p* [L]"""
        return self.wave / np.pi * np.arcsin(np.sqrt(self.mean / self.full))

    def pressure(self, x):
        """2 p* cos(pi x/l) sqrt(sin^2(pi a/l) - sin^2(pi x/l))"""
        inner = self.mean / self.full - np.sin(np.pi * x / self.wave) ** 2
        return 2.0 * self.full * np.cos(np.pi * x / self.wave) * np.sqrt(np.maximum(0.0, inner))


def punch_force(load, share):
    """Force [F L-1] on |x| < share a of a flat punch without friction, p = P/(pi sqrt(a^2 -
    x^2)) (Sadowsky 1928): 2 P asin(share)/pi."""
    return 2.0 * load * np.arcsin(share) / np.pi


# ---------------------------------------------------------------- command line


class SpinningTube:
    """A tube of regular polygons, one element through, PR 0, that flies at a rigid plane
    along its axis and spins about it: a plane pressure wave, and a torsional wave with Coulomb
    friction at the foot (plane waves of rods; friction of a ring of constant pressure). Areas
    are those of the polygons, so that the mesh has them exactly."""

    def __init__(self, corners, inner, outer, length, modulus, density, velocity, mu):
        half = np.pi / corners
        self.area = corners * np.sin(2 * half) / 2 * (outer**2 - inner**2)
        self.radius = 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)
        self.speed = np.sqrt(modulus / density)
        self.force = density * self.speed * velocity * self.area
        self.torque = mu * self.force * self.radius
        self.contact_time = 2 * length / self.speed

    def spin_after(self, spin, inertia):
        """Of a tube that slips all the time: inertia of its mass matrix about the axis."""
        return spin - self.torque * self.contact_time / inertia


def slide_down(slope, gravity, mu, velocity, time):
    """Place and velocity (x down the slope, y across it) of a block thrown with `velocity` on a
    plane inclined by `slope`: Coulomb's friction against the velocity, by Runge and Kutta's
    fourth-order method, 4000 steps."""
    drive, grip = gravity * np.sin(slope), mu * gravity * np.cos(slope)

    def rate(s):
        speed = np.hypot(s[2], s[3])
        return s[2], s[3], drive - grip * s[2] / speed, -grip * s[3] / speed

    steps, state = 4000, (0.0, 0.0) + tuple(velocity)
    h = time / steps
    for _ in range(steps):
        slopes = [rate(state)]
        for share in (0.5, 0.5, 1.0):
            slopes += [rate([a + share * h * b for a, b in zip(state, slopes[-1])])]
        state = tuple(
            a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(state, *slopes)
        )
    return state


def print_history(exact, rows):
    """Table of the exact history at equal times."""
    t = np.linspace(0.0, exact.tend, rows)
    columns = (
        t,
        *exact.displacement(t),
        exact.force(t),
        *exact.energies(t),
        *exact.mean_velocities(t),
    )
    names = ("time", "u1", "u2", "force", "kinetic", "strain", "v_cm1", "v_cm2")
    print("#" + " ".join(n.rjust(14) for n in names))
    for row in zip(*columns):
        print(" " + " ".join("%14.6e" % value for value in row))


def main(argv=None):
    parser = argparse.ArgumentParser(
        description="Print the exact history of the impact of two bars (1-D waves)."
    )
    for name, default, text in (
        ("length", 10.0, "of bar 1 [L]"),
        ("length2", None, "of bar 2, default equal"),
        ("speed", 1000.0, "wave speed of bar 1 [L T-1]"),
        ("speed2", None, "of bar 2"),
        ("impedance", 1.0, "rho c A of bar 1 [M T-1]"),
        ("impedance2", None, "of bar 2"),
        ("v1", 1.0, "velocity of bar 1 [L T-1]"),
        ("v2", -1.0, "velocity of bar 2"),
        ("gap", 0.02, "[L]"),
        ("tend", 0.04, "end of the history [T]"),
    ):
        parser.add_argument("--" + name, type=float, default=default, help=text)
    parser.add_argument("--rows", type=int, default=41, help="number of times (default 41)")
    a = parser.parse_args(argv)
    second = [a.length2, a.speed2, a.impedance2]
    first = [a.length, a.speed, a.impedance]
    second = [f if s is None else s for f, s in zip(first, second)]
    print_history(Impact(Bar(*first, a.v1), Bar(*second, a.v2), a.gap, a.tend), a.rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
