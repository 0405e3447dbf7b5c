//! A closed track for what drives round in the built-in scenes.

/// A quarter turn, radians.
const QUARTER: f64 = std::f64::consts::FRAC_PI_2;

/// A closed track around the origin: a rectangle with rounded corners, driven counter-clockwise seen from above.
pub(super) struct Track {
    /// Half extents along x and z, metres.
    pub half: [f64; 2],
    /// Of the corners, at most the smaller half extent.
    pub radius: f64,
}

impl Track {
    /// Straight along x, quarter arc, straight along z, quarter arc: half of the track.
    fn parts(&self) -> [f64; 4] {
        let arc = QUARTER * self.radius;
        [
            2.0 * (self.half[0] - self.radius),
            arc,
            2.0 * (self.half[1] - self.radius),
            arc,
        ]
    }

    /// Length of the track, metres.
    pub fn length(&self) -> f64 {
        2.0 * self.parts().iter().sum::<f64>()
    }

    /// Place (x, z) and heading (radians about +Y, from +Z) at `turn` turns.
    pub fn at(&self, turn: f64) -> ([f64; 2], f64) {
        let turn = turn - libm::floor(turn);
        let half_turn = 2.0 * turn;
        // The second half is the first, seen from the other side.
        let (side, along) = if half_turn < 1.0 {
            (1.0, half_turn)
        } else {
            (-1.0, half_turn - 1.0)
        };
        let s = along * 0.5 * self.length();
        let [straight, arc, other, _] = self.parts();
        let inner = [self.half[0] - self.radius, self.half[1] - self.radius];
        let corner = |cx: f64, cz: f64, angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            (
                [cx + self.radius * sine, cz + self.radius * cosine],
                QUARTER + angle,
            )
        };
        let (past_first, past_corner) = (s - straight, s - straight - arc);
        let (place, heading) = if past_first < 0.0 {
            ([s - inner[0], self.half[1]], QUARTER)
        } else if past_corner < 0.0 {
            corner(inner[0], inner[1], past_first / self.radius)
        } else if past_corner < other {
            ([self.half[0], inner[1] - past_corner], 2.0 * QUARTER)
        } else {
            corner(inner[0], -inner[1], QUARTER + (past_corner - other) / self.radius)
        };
        let turned = if side > 0.0 {
            heading
        } else {
            heading + 2.0 * QUARTER
        };
        (place.map(|x| x * side), turned)
    }

    /// Turns at which keys are needed, from `start` to `start + 1`, both included.
    pub fn stops(&self, start: f64) -> Vec<f64> {
        let mut marks = Vec::new();
        let mut s = 0.0;
        for (index, part) in self.parts().iter().cycle().take(8).enumerate() {
            let steps = if index % 2 == 0 { 1 } else { 8 };
            marks.extend((0..steps).map(|i| (s + part * f64::from(i) / f64::from(steps)) / self.length()));
            s += part;
        }
        let start_turn = start - libm::floor(start);
        let mut stops = vec![start];
        let mut between: Vec<f64> = marks
            .iter()
            .map(|mark| {
                let ahead = mark - start_turn;
                ahead - libm::floor(ahead)
            })
            .filter(|ahead| *ahead > 1e-6 && *ahead < 1.0 - 1e-6)
            .collect();
        between.sort_by(f64::total_cmp);
        between.dedup();
        stops.extend(between.iter().map(|ahead| start + ahead));
        stops.push(start + 1.0);
        stops
    }
}
