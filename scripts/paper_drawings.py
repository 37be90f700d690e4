"""The two figures of the paper that are drawings, as SVG: densities over the eccentricity (Figure 1), and the acuity
function as a volume (Figure 5). Both draw points that they are given; neither knows a formula of the program's."""

import math
from xml.sax.saxutils import escape

RED, GREEN, BLUE, GREY = (200, 48, 40), (70, 160, 80), (60, 100, 200), (150, 150, 150)


def colour(rgb, light=1.0):
    return "#" + "".join(f"{max(0, min(255, round(channel * light))):02x}" for channel in rgb)


def text(x, y, words, size=13, anchor="middle", more=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="currentColor" {more}>'
            f"{escape(str(words))}</text>")


def line(a, b, rgb=GREY, width=1.0, more=""):
    return (f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{colour(rgb)}" '
            f'stroke-width="{width}" {more}/>')


def svg(width, height, title, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" '
            f'font-family="system-ui, sans-serif" color="#444"><title>{escape(title)}</title>\n' + "\n".join(parts) + "\n</svg>\n")


class Curve:
    """`points`: (eccentricity in degrees, samples or pixels per degree). `dash`, `filled`: how it is drawn."""

    def __init__(self, name, points, rgb, dash="", filled=False, width=2.0):
        self.name, self.points, self.rgb, self.dash, self.filled, self.width = name, points, rgb, dash, filled, width


class Frame:
    """The plane of a diagram: degrees to both sides of the gaze, densities by their logarithm."""

    def __init__(self, most_deg, lowest, highest, size=(820, 480), margins=(64, 24, 20, 116)):
        self.most_deg, self.lowest, self.highest, self.size = most_deg, lowest, highest, size
        self.left, self.top = margins[0], margins[2]
        self.right, self.bottom = size[0] - margins[1], size[1] - margins[3]

    def at(self, deg, density):
        share = math.log(density / self.lowest) / math.log(self.highest / self.lowest)
        x = self.left + (deg + self.most_deg) / (2 * self.most_deg) * (self.right - self.left)
        return x, self.bottom - share * (self.bottom - self.top)

    def axes(self, x_name, y_name):
        parts = []
        for density in (1, 2, 5, 10, 20, 30, 60, 100, 200):
            if self.lowest <= density <= self.highest:
                left, right = self.at(-self.most_deg, density), self.at(self.most_deg, density)
                parts += [line(left, right, (222, 222, 222), 1), text(left[0] - 8, left[1] + 4, density, anchor="end")]
        for deg in range(-self.most_deg, self.most_deg + 1, 15):
            x = self.at(deg, self.lowest)[0]
            parts += [line((x, self.bottom), (x, self.bottom + 5)), text(x, self.bottom + 19, abs(deg))]
        middle = (self.left + self.right) / 2
        parts.append(text(middle, self.bottom + 38, x_name))
        parts.append(text(16, (self.top + self.bottom) / 2, y_name,
                          more=f'transform="rotate(-90 16 {(self.top + self.bottom) / 2:.1f})"'))
        return parts

    def path(self, curve):
        """The curve to both sides, mirrored; what leaves the plane is left out."""
        inside = [(deg, density) for deg, density in curve.points
                  if 0 <= deg <= self.most_deg and self.lowest <= density <= self.highest]
        both = [(-deg, density) for deg, density in reversed(inside)] + inside
        at = ["{:.1f} {:.1f}".format(*self.at(*point)) for point in both]
        half = len(inside)
        steps = " L".join(at) if not inside or inside[0][0] == 0 else " L".join(at[:half]) + " M" + " L".join(at[half:])
        if not curve.filled:
            return f'<path d="M{steps}" fill="none" stroke="{colour(curve.rgb)}" stroke-width="{curve.width}" stroke-dasharray="{curve.dash}"/>'
        first, last = self.at(both[0][0], self.lowest), self.at(both[-1][0], self.lowest)
        return (f'<path d="M{first[0]:.1f} {first[1]:.1f} L{steps} L{last[0]:.1f} {last[1]:.1f} Z" '
                f'fill="{colour(curve.rgb)}" fill-opacity="0.25" stroke="{colour(curve.rgb)}"/>')

    def legend(self, curves):
        parts, columns = [], 2
        for i, curve in enumerate(curves):
            x = self.left + (i % columns) * (self.right - self.left) / columns
            y = self.bottom + 60 + (i // columns) * 19
            thick = 9 if curve.filled else curve.width
            parts += [line((x, y - 4), (x + 28, y - 4), curve.rgb, thick,
                           f'stroke-dasharray="{curve.dash}"' + (' stroke-opacity="0.4"' if curve.filled else "")),
                      text(x + 36, y, curve.name, anchor="start")]
        return parts


def density_diagram(curves, title, most_deg=60, lowest=1, highest=300):
    """Figure 1."""
    frame = Frame(most_deg, lowest, highest)
    filled_first = sorted(curves, key=lambda curve: not curve.filled)
    return svg(*frame.size, title, frame.axes("degrees from the gaze", "per degree") +
               [frame.path(curve) for curve in filled_first] + frame.legend(curves))


class View:
    """Parallel projection of (x°, y°, density) from above and aside."""

    def __init__(self, turn_deg, above_deg, scale, height_scale, middle):
        self.turn, self.above = math.radians(turn_deg), math.radians(above_deg)
        self.scale, self.height_scale, self.middle = scale, height_scale, middle

    def turned(self, x, y):
        return (x * math.cos(self.turn) - y * math.sin(self.turn), x * math.sin(self.turn) + y * math.cos(self.turn))

    def at(self, x, y, density):
        right, away = self.turned(x, y)
        up = away * math.sin(self.above) + density * self.height_scale * math.cos(self.above)
        return self.middle[0] + right * self.scale, self.middle[1] - up * self.scale

    def away(self, x, y):
        return self.turned(x, y)[1]


def crossing(points, density):
    """The eccentricity at which the curve falls through a density, on the straight line between its points."""
    for (a, high), (b, low) in zip(points, points[1:]):
        if high >= density > low:
            return a + (b - a) * (high - density) / (high - low)
    return None


def rings_of(points, sharp_density, far_deg):
    """The points with those added at which the colour changes, so that its borders are exact."""
    extra = []
    for deg in (crossing(points, sharp_density), far_deg):
        if deg is None:
            continue
        for (a, high), (b, low) in zip(points, points[1:]):
            if a < deg < b:
                extra.append((deg, high + (low - high) * (deg - a) / (b - a)))
    return sorted(set(points) | set(extra))


def facet(view, ring, next_ring, phi, next_phi, rgb):
    """One piece of the surface: (how far away, SVG)."""
    corners = [(deg * math.cos(angle), deg * math.sin(angle), density)
               for (deg, density), angle in ((ring, phi), (next_ring, phi), (next_ring, next_phi), (ring, next_phi))]
    middle = (phi + next_phi) / 2
    slope = (ring[1] - next_ring[1]) * view.height_scale / max(next_ring[0] - ring[0], 1e-9)
    length = math.hypot(slope, 1)
    normal = (slope * math.cos(middle) / length, slope * math.sin(middle) / length, 1 / length)
    sun = view.turned(normal[0], normal[1])
    light = 0.55 + 0.5 * max(0.0, -0.55 * sun[0] - 0.45 * sun[1] + 0.7 * normal[2])
    at = " ".join("{:.1f},{:.1f}".format(*view.at(*corner)) for corner in corners)
    fill = colour(rgb, light)
    mean = (ring[0] + next_ring[0]) / 2
    return (view.away(mean * math.cos(middle), mean * math.sin(middle)),
            f'<polygon points="{at}" fill="{fill}" stroke="{fill}" stroke-width="0.6"/>')


def acuity_volume(points, title, sharp_density=60, far_deg=45, sectors=60):
    """Figure 5: `points` (eccentricity, density) from 0 outwards, turned about the gaze."""
    size = (820, 570)
    most = points[-1][0]
    highest = points[0][1]
    view = View(turn_deg=-25, above_deg=24, scale=300 / most, height_scale=1.2 * most / highest,
                middle=(430, 375))
    rings = [*rings_of(points, sharp_density, far_deg), (most, 0.0)]  # down to the ground
    facets = []
    for ring, next_ring in zip(rings, rings[1:]):
        rgb = BLUE if ring[0] >= far_deg else RED if next_ring[1] >= sharp_density else GREEN
        for k in range(sectors):
            facets.append(facet(view, ring, next_ring, 2 * math.pi * k / sectors, 2 * math.pi * (k + 1) / sectors, rgb))
    facets.sort(key=lambda one: -one[0])
    return svg(*size, title, wall(view, most, highest, sharp_density) + [drawn for _, drawn in facets] +
               floor_marks(view, most, far_deg))


def wall(view, most, highest, sharp_density):
    """The vertical scale, at the volume's left; the line across is where it ends at the axis."""
    x, y = -1.08 * most * math.cos(-view.turn), -1.08 * most * math.sin(-view.turn)
    parts = [line(view.at(x, y, 0), view.at(x, y, highest))]
    for density in (0, sharp_density, 100, 150, 200):
        if density > highest:
            continue
        at, axis = view.at(x, y, density), view.at(0, 0, density)
        sharp = density == sharp_density
        parts += [line(at, axis if sharp else (at[0] + 8, at[1]), RED if sharp else GREY, 1, 'stroke-dasharray="3 4"' if sharp else ""),
                  text(at[0] - 8, at[1] + 4, density, anchor="end")]
    top = view.at(x, y, highest)
    parts.append(text(top[0], top[1] - 14, "samples per degree"))
    return parts


def floor_marks(view, most, far_deg):
    """Eccentricities along the front edge."""
    parts = []
    for deg in range(0, int(most) + 1, 15):
        for side in (-1, 1) if deg else (1,):
            # Along the line that lies across the view, in front of the volume.
            turn = -view.turn
            x, y = side * deg * math.cos(turn), side * deg * math.sin(turn)
            front = (-math.sin(turn) * -1.12 * most, math.cos(turn) * -1.12 * most)
            at = view.at(x + front[0], y + front[1], 0)
            parts += [line((at[0], at[1]), (at[0], at[1] + 6), BLUE if deg >= far_deg else GREY),
                      text(at[0], at[1] + 22, f"{deg}°")]
    turn = -view.turn
    low = view.at(math.sin(turn) * 1.12 * most, -math.cos(turn) * 1.12 * most, 0)
    parts.append(text(low[0], low[1] + 44, "degrees from the gaze"))
    return parts
