// What stands around the motion: axes in a plane, a box in space.

Object.assign(Motion.prototype, {
    axes(context) {
        const { left, top, right, bottom } = this.frame;
        const lengths = [right - left, bottom - top].map(pixels => pixels / this.scale);
        const step = niceStep(lengths[0], Math.max(2, (right - left) / 80));
        const [muted, grid] = [themed("--muted"), themed("--grid")];
        const along = axis => {
            const [low, high] = [-1, 1].map(side => this.centre[axis] + side * lengths[axis] / 2);
            const count = Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1;
            return Array.from({ length: count }, (_, k) => (Math.ceil(low / step - 1e-9) + k) * step);
        };
        const [across, up] = [along(0), along(1)];
        const texts = [ticks(across, step), ticks(up, step)];
        context.fillStyle = muted;
        across.forEach((value, k) => {
            const [x] = this.project(value, 0);
            this.line(context, [[x, top], [x, bottom]], grid, 1);
            Object.assign(context, { textAlign: "center", textBaseline: "top" });
            context.fillText(texts[0][k], x, bottom + 6);
        });
        up.forEach((value, k) => {
            const [, y] = this.project(0, value);
            this.line(context, [[left, y], [right, y]], grid, 1);
            Object.assign(context, { textAlign: "right", textBaseline: "middle" });
            context.fillText(texts[1][k], left - 6, y);
        });
        Object.assign(context, { textAlign: "center", textBaseline: "bottom" });
        context.fillText(this.labels[0], (left + right) / 2, bottom + 42);
        context.save();
        context.translate(0, (top + bottom) / 2);
        context.rotate(-Math.PI / 2);
        Object.assign(context, { textBaseline: "top" });
        context.fillText(this.labels[1], 0, 2);
        context.restore();
    },

    /** The edges of the box along an axis: whether they end at its nearest corner, or lie on its outline. */
    edges(axis) {
        const others = [0, 1, 2].filter(other => other !== axis);
        const place = (side, k) => this.centre[k] + side * this.halves[k];
        const corner = sides => this.project(...sides.map(place));
        const moved = (sides, other, side) => sides.map((old, k) => k === other ? side : old);
        const isNear = other => corner(moved([0, 0, 0], other, 1))[2] > 0 ? 1 : -1;
        return [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(sides => {
            const from = [0, 1, 2].map(k => k === axis ? -1 : sides[others.indexOf(k)]);
            const near = others.filter(other => from[other] === isNear(other)).length;
            const ends = [corner(from), corner(moved(from, axis, 1))];
            return { ends, isFront: near === 2, isOutline: near === 1 };
        });
    },

    /** The edges of the box but for those in front, with a name and numbers along each axis. */
    box(context) {
        const step = niceStep(2 * Math.max(...this.halves), 5);
        const [line, muted, ink] = ["--line", "--muted", "--ink"].map(themed);
        context.textBaseline = "middle";
        for (const axis of [0, 1, 2]) {
            const edges = this.edges(axis);
            for (const { ends, isFront } of edges) if (!isFront) this.line(context, ends, line, 1);
            // The numbers stand below the box, and those of the height at its left.
            const place = ({ ends: [a, b] }) => axis === 2 ? -(a[0] + b[0]) : a[1] + b[1];
            const { ends } = edges.filter(({ isOutline }) => isOutline)
                .reduce((a, b) => place(b) > place(a) ? b : a);
            const [low, high] = [-1, 1].map(side => this.centre[axis] + side * this.halves[axis]);
            const count = Math.floor(high / step) - Math.ceil(low / step) + 1;
            const values = Array.from({ length: count }, (_, k) => (Math.ceil(low / step) + k) * step);
            const texts = ticks(values, step);
            context.fillStyle = muted;
            values.forEach((value, k) => {
                const part = (value - low) / (high - low);
                // At a corner the numbers of two axes would meet.
                if (part > 0.06 && part < 0.94) this.beside(context, texts[k], ends, part, 10);
            });
            context.fillStyle = ink;
            this.beside(context, this.labels[axis], ends, 0.5, 38);
        }
    },

    /** Writes a text at a part of the way between two points, moved away from the middle, on the canvas. */
    beside(context, text, [from, to], part, away) {
        const [x, y] = [0, 1].map(k => from[k] + (to[k] - from[k]) * part);
        const [dx, dy] = [x - this.middle[0], y - this.middle[1]];
        const length = Math.hypot(dx, dy) || 1;
        const width = context.measureText(text).width, room = this.canvas.clientWidth - 4 - width;
        const before = dx < -0.25 * length ? width : dx > 0.25 * length ? 0 : width / 2;
        context.textAlign = "left";
        const left = x + away * dx / length - before;
        context.fillText(text, Math.max(4, Math.min(room, left)), y + away * dy / length);
    },
});
