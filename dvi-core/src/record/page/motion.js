// The bodies as they move: in a plane with its axes, in space in a box that can be turned. Scales are equal.

/** So many points of trails are drawn in all. */
const MOST_IN_TRAILS = 20000;
/** A trail fades in so many parts; in fewer if there are many. */
const FADES = 12, FADES_OF_MANY = 4, MANY = 40;

class Motion {
    constructor(section, record) {
        Object.assign(this, { section, record, row: 0, trail: 0.25, azimuth: -0.9, elevation: 0.42 });
        this.canvas = section.querySelector("canvas");
        this.isSpace = record.bodies.some(({ position }) => position.length === 3);
        section.classList.toggle("space", this.isSpace);
        const axes = this.isSpace ? [0, 1, 2] : [0, 1];
        const along = axis => record.bodies.flatMap(({ position, is_arm }) => [
            ...(position[axis] ? [position[axis].values] : []), ...(is_arm ? [[0]] : []),
        ]);
        const extents = axes.map(axis => extent(...along(axis)));
        this.centre = extents.map(([low, high]) => (low + high) / 2);
        // The sides of the box. None is short beside the others, or zero.
        const halves = extents.map(([low, high]) => (high - low) / 2 * 1.08);
        const least = (Math.max(...halves) || Math.abs(this.centre[0]) || 1) * 0.5;
        this.halves = halves.map(half => Math.max(half, least));
        this.size = Math.hypot(...this.halves);
        this.labels = axes.map(axis => this.labelOf(axis));
        if (this.isSpace) this.listen();
    }

    /** The name of the only column along an axis, or of the axis; with the unit that all have. */
    labelOf(axis) {
        const columns = this.record.bodies.map(({ position }) => position[axis]).filter(Boolean);
        const name = columns.length === 1 ? columns[0].name : "xyz"[axis];
        const units = new Set(columns.map(({ unit }) => unit));
        return label({ name, unit: units.size === 1 ? [...units][0] : "" });
    }

    listen() {
        const turn = (across, up) => {
            this.azimuth -= across;
            this.elevation = Math.max(-1.57, Math.min(1.57, this.elevation + up));
            this.draw();
        };
        this.canvas.addEventListener("pointerdown", event => this.canvas.setPointerCapture(event.pointerId));
        this.canvas.addEventListener("pointermove", event => {
            if (event.buttons) turn(event.movementX * 0.01, event.movementY * 0.01);
        });
        this.canvas.addEventListener("keydown", event => {
            const [across, up] = {
                ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1],
            }[event.key] ?? [];
            if (across === undefined) return;
            event.preventDefault();
            turn(across, up);
        });
        this.section.querySelector(".note").textContent = "Drag to turn.";
    }

    move(row) {
        this.row = row;
        this.draw();
    }

    /** The canvas in the pixels of the screen, and where the middle of the motion is in it. */
    prepare() {
        // Room for numbers and names at the left and below.
        const [left, right, top, bottom] = this.isSpace ? [0, 0, 0, 0] : [58, 10, 8, 44];
        const width = this.canvas.clientWidth, dots = devicePixelRatio;
        const ratio = this.isSpace ? 1 : this.halves[1] / this.halves[0];
        const height = Math.min(width, 560, (width - left - right) * ratio + top + bottom);
        const [across, down] = [width, height].map(size => Math.round(size * dots));
        if (this.canvas.width !== across || this.canvas.height !== down) {
            Object.assign(this.canvas, { width: across, height: down });
            this.canvas.style.height = `${height}px`;
        }
        const context = this.canvas.getContext("2d");
        context.setTransform(dots, 0, 0, dots, 0, 0);
        context.clearRect(0, 0, width, height);
        Object.assign(context, { font: FONT, lineJoin: "round", lineCap: "round" });
        const [w, h] = [width - left - right, height - top - bottom];
        this.scale = this.isSpace
            ? Math.min(w, h) / (2 * this.size) * 0.92
            : Math.min(w / (2 * this.halves[0]), h / (2 * this.halves[1]));
        this.middle = [left + w / 2, top + h / 2];
        this.frame = { left, top, right: left + w, bottom: top + h };
        return context;
    }

    /** The pixels of a point, and how near it is. */
    project(x, y, z) {
        let [across, up, near] = [x - this.centre[0], y - this.centre[1], 0];
        if (this.isSpace) {
            const [ca, sa, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth),
                Math.cos(this.elevation), Math.sin(this.elevation)];
            const [ahead, height] = [ca * across + sa * up, (z ?? 0) - this.centre[2]];
            [across, up, near] = [ca * up - sa * across, ce * height - se * ahead, ce * ahead + se * height];
        }
        return [this.middle[0] + across * this.scale, this.middle[1] - up * this.scale, near / this.size];
    }

    at(body, row) {
        return this.project(...body.position.map(({ values }) => values[row]));
    }

    draw() {
        const context = this.prepare();
        if (this.isSpace) this.box(context); else this.axes(context);
        const { bodies } = this.record;
        const [ink, radius] = [themed("--paper"), bodies.length > MANY ? 2.5 : 5];
        const palette = Array.from({ length: colours }, (_, index) => colour(index));
        const drawn = bodies.map((body, index) => {
            return { body, colour: palette[index % colours], place: this.at(body, this.row) };
        });
        for (const { body, colour } of drawn) this.path(context, body, colour);
        drawn.sort((a, b) => a.place[2] - b.place[2]);
        for (const { body, colour, place: [x, y, near] } of drawn) {
            if (!isFinite(x) || !isFinite(y)) continue;
            if (body.is_arm) this.line(context, [this.project(0, 0, 0), [x, y]], colour, 2.5);
            context.beginPath();
            context.arc(x, y, radius * (1 + 0.4 * near), 0, 2 * Math.PI);
            Object.assign(context, { fillStyle: colour, strokeStyle: ink, lineWidth: 1.5 });
            context.fill();
            context.stroke();
        }
    }

    /** Where a body has been, the older the fainter. */
    path(context, body, colour) {
        const { rows, bodies } = this.record;
        const length = Math.min(this.row, Math.round(rows * this.trail));
        const every = Math.max(1, Math.ceil(length * bodies.length / MOST_IN_TRAILS));
        Object.assign(context, { strokeStyle: colour, lineWidth: 1.6 });
        const first = Math.ceil((this.row - length) / every) * every;
        const fades = bodies.length > MANY ? FADES_OF_MANY : FADES;
        for (let fade = 0; fade < fades; fade++) {
            const part = k => first + Math.round(length * k / fades / every) * every;
            const [begin, end] = [part(fade), part(fade + 1)];
            context.globalAlpha = this.trail < 1 ? (fade + 1) / fades : 0.75;
            const points = [];
            const last = Math.min(end, this.row);
            for (let row = begin; row < last; row += every) points.push(this.at(body, row));
            points.push(this.at(body, last));
            this.line(context, points, colour, 1.6);
        }
        context.globalAlpha = 1;
    }

    line(context, points, colour, width) {
        context.beginPath();
        let isDrawing = false;
        for (const [x, y] of points) {
            const isPoint = isFinite(x) && isFinite(y);
            if (isPoint) isDrawing ? context.lineTo(x, y) : context.moveTo(x, y);
            isDrawing = isPoint;
        }
        Object.assign(context, { strokeStyle: colour, lineWidth: width });
        context.stroke();
    }
}
