const poseSize = 7;  // x, y, z, then the quaternion w, x, y, z

/** The position of a body, in units of length from the middle of the box, and its orientation. */
function solidPose(film, k, i) {
  const at = film.placeOf(k, i), box = film.boxAt(k);
  const signed = (value) => (value << 16 >> 16) / 32767;
  return { centre: box.map((side, axis) => (film.poses[at + axis] / 65536 - 0.5) * side),
           turn: [3, 4, 5, 6].map((part) => signed(film.poses[at + part])) };
}

// Colours

// Colours of the three axes. An axis w has a mixture of them with the shares w_k², whose sum is 1. The colours differ
// in lightness and from blue to yellow, which everyone can distinguish.
const axisColours = [[238, 170, 40], [52, 176, 160], [84, 72, 196]];

function mixedColour(shares) {
  const mixed = [0, 1, 2].map((channel) => shares.reduce((sum, share, k) => sum + share * axisColours[k][channel], 0));
  return `rgb(${mixed.map(Math.round).join(' ')})`;
}

/** The red, green and blue of #rrggbb or rgb(…). */
const components = (colour) => colour[0] === '#' ? [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16))
  : colour.match(/[\d.]+/g).slice(0, 3).map(Number);

/** The axis that shows the orientation of a body: the axis of symmetry, else the longest. */
function figureAxis([a, b, c], [w, x, y, z]) {
  const own = b === c ? 0 : a === c ? 1 : a === b ? 2 : [a, b, c].indexOf(Math.max(a, b, c));
  return [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
          [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
          [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]][own];
}

/** Draws all mixtures in a triangle with the axes at its corners. */
function drawAxesKey(ctx) {
  const side = 66, height = side * Math.sqrt(0.75), left = 24, top = 14;
  for (let row = 0; row < height; ++row) for (let column = 0; column < side; ++column) {
    const z = 1 - row / height, y = (column - 0.5 * side * z) / side, x = 1 - y - z;
    if (x < 0 || y < 0) continue;
    ctx.fillStyle = mixedColour([x, y, z]);
    ctx.fillRect(left + column, top + row, 1.2, 1.2);
  }
  keyLabel(ctx, left - 8, 'x', top + height + 2);
  keyLabel(ctx, left + side + 8, 'y', top + height + 2);
  keyLabel(ctx, left + 0.5 * side, 'z', top - 3);
}

const solidColourings = {
  orientation: {
    name: 'orientation', offered: (film) => film.rotors,
    of: (film, k, i) => isRound(film.axesOf(i)) ? roundGrey
      : mixedColour(figureAxis(film.axesOf(i), solidPose(film, k, i).turn).map((w) => w * w)),
    key: drawAxesKey, keyHeight: 78,
    text: (film) => 'direction of the axis of symmetry (of scalene bodies: of the longest axis)' + greyIfRound(film),
  },
  ...commonColourings,
};

// The bodies are drawn by WebGL. Parallel rays along z of the view meet each body within the ellipse onto which it is
// projected. The part of the ray that lies in the body, in the box and behind the slice is computed exactly in every
// pixel, so that cuts are flat and exact.

const solidVertices = `#version 300 es
  layout(location = 0) in vec3 centre;
  layout(location = 1) in vec4 turn;  // quaternion w, x, y, z
  layout(location = 2) in vec3 axes;
  layout(location = 3) in vec3 paint;
  uniform mat3 view;
  uniform vec4 window;  // centre x, y; scale; of depth
  uniform float pixel;
  flat out mat3 stretch;  // from the unit sphere to the body, in the view
  flat out vec3 colour;
  out vec3 ray;  // of this pixel, in the plane of the centre: from there in the unit sphere
  out vec3 place;  // the same in the box
  flat out float height;

  mat3 rotation(vec4 q) {
    vec3 s = 2. * q.yzw;
    vec3 w = q.x * s, x = q.y * s, y = q.z * s, z = q.w * s;
    return mat3(1. - y.y - z.z, x.y + w.z, x.z - w.y, x.y - w.z, 1. - x.x - z.z, y.z + w.x, x.z + w.y, y.z - w.x, 1. - x.x - y.y);
  }

  void main() {
    mat3 turned = view * rotation(turn / length(turn));
    stretch = mat3(turned[0] * axes.x, turned[1] * axes.y, turned[2] * axes.z);
    // The ellipse: xᵀ S⁻¹ x = 1 with the block S of the shape matrix.
    vec3 x = vec3(stretch[0].x, stretch[1].x, stretch[2].x), y = vec3(stretch[0].y, stretch[1].y, stretch[2].y);
    float xx = dot(x, x), yy = dot(y, y), xy = dot(x, y);
    float mean = .5 * (xx + yy), half_gap = length(vec2(.5 * (xx - yy), xy));
    float angle = half_gap > 0. ? .5 * atan(xy, .5 * (xx - yy)) : 0.;
    float large = mean + half_gap, small = max(xx * yy - xy * xy, 0.) / large;
    vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2) * 2. - 1.;
    vec2 along = vec2(cos(angle), sin(angle));
    vec2 off = corner.x * (sqrt(large) + pixel) * along + corner.y * (sqrt(small) + pixel) * vec2(-along.y, along.x);
    vec3 middle = view * centre;
    height = middle.z;
    ray = transpose(turned) * vec3(off, 0) / axes;
    place = transpose(view) * (middle + vec3(off, 0));
    colour = paint / 255.;
    gl_Position = vec4((middle.xy + off - window.xy) * window.z, 0, 1);
  }`;

const solidPixels = `#version 300 es
  precision highp float;
  uniform mat3 view;
  uniform vec4 window;
  uniform vec3 box;  // half its sides
  uniform bool cut;
  uniform vec4 slice;  // normal in the box, and how far it reaches
  uniform vec3 page;
  flat in mat3 stretch;
  flat in vec3 colour;
  in vec3 ray;
  in vec3 place;
  flat in float height;
  out vec4 shown;

  void main() {
    vec3 toward = vec3(view[0].z, view[1].z, view[2].z);  // z of the view, in the box
    vec3 axes2 = vec3(dot(stretch[0], stretch[0]), dot(stretch[1], stretch[1]), dot(stretch[2], stretch[2]));
    vec3 step = vec3(stretch[0].z, stretch[1].z, stretch[2].z) / axes2;
    // |ray + s step| = 1
    float a = dot(step, step), b = dot(ray, step), c = dot(ray, ray) - 1.;
    float root = b * b - a * c;
    if (root < 0.) discard;
    root = sqrt(root);
    float top = (root - b) / a, bottom = (-root - b) / a;
    vec3 normal = vec3(0);  // of the plane that cuts the body, none as yet
    if (cut) for (int k = 0; k < 3; ++k) {
      if (abs(toward[k]) < 1e-6) { if (abs(place[k]) > box[k]) discard; continue; }
      float side = sign(toward[k]);
      float end = (side * box[k] - place[k]) / toward[k];
      if (end < top) { top = end; normal = vec3(0); normal[k] = side; }
      bottom = max(bottom, (-side * box[k] - place[k]) / toward[k]);
    }
    float rise = dot(slice.xyz, toward), room = slice.w - dot(slice.xyz, place);
    if (abs(rise) < 1e-6) { if (room < 0.) discard; }
    else if (rise < 0.) bottom = max(bottom, room / rise);
    else if (room / rise < top) { top = room / rise; normal = slice.xyz; }
    if (top < bottom) discard;

    vec3 sphere = ray + top * step;
    bool flat_cut = normal != vec3(0);
    vec3 n = flat_cut ? view * normal : normalize(stretch * (sphere / axes2));
    float facing = clamp(dot(n, normalize(vec3(-.35, .45, .82))), 0., 1.);
    vec3 lit = colour * (.38 + .62 * facing);
    if (flat_cut) {
      float rim = length(sphere);
      lit = mix(colour, vec3(1), .12) * (.62 + .3 * facing) * mix(.45, 1., smoothstep(0., 2. * fwidth(rim) + 1e-4, 1. - rim));
    } else lit += .18 * pow(facing, 24.);
    float depth = .5 - .5 * (height + top) * window.w;
    shown = vec4(mix(lit, page, .28 * smoothstep(.3, 1., depth)), 1);
    gl_FragDepth = depth;
  }`;

const edgeVertices = `#version 300 es
  layout(location = 0) in vec3 start;
  layout(location = 1) in vec3 end;
  uniform mat3 view;
  uniform vec4 window;
  uniform float pixel;
  void main() {
    vec3 p = view * start, q = view * end;
    vec2 along = q.xy - p.xy;
    vec2 across = length(along) > 0. ? normalize(vec2(-along.y, along.x)) : vec2(0);
    vec3 at = gl_VertexID / 2 == 0 ? p : q;
    at.xy += across * pixel * (gl_VertexID % 2 == 0 ? -1.3 : 1.3);
    // A little nearer than faces in the same place.
    gl_Position = vec4((at.xy - window.xy) * window.z, -at.z * window.w - 2e-4, 1);
  }`;

const edgePixels = `#version 300 es
  precision highp float;
  uniform vec3 ink;
  out vec4 shown;
  void main() { shown = vec4(ink, 1); }`;

class SolidPainter {
  /** Throws if there is no WebGL 2. */
  constructor() {
    this.canvas = document.createElement('canvas');
    this.gl = this.canvas.getContext('webgl2', { antialias: false, alpha: true, premultipliedAlpha: true });
    if (!this.gl) throw new Error('no WebGL 2');
    this.solids = this.program(solidVertices, solidPixels);
    this.edges = this.program(edgeVertices, edgePixels);
  }

  program(vertices, pixels) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertices], [gl.FRAGMENT_SHADER, pixels]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(gl.getAttachedShaders(program).map((shader) => gl.getShaderInfoLog(shader)).join());
    return { program, place: (name) => gl.getUniformLocation(program, name), array: gl.createVertexArray(), buffer: gl.createBuffer() };
  }

  /** Fills the buffer with the numbers of all instances. `sizes` are those of their attributes. */
  fill({ array, buffer }, numbers, sizes) {
    const { gl } = this;
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.DYNAMIC_DRAW);
    const stride = 4 * sizes.reduce((sum, size) => sum + size);
    sizes.reduce((offset, size, k) => {
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, size, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(k, 1);
      return offset + 4 * size;
    }, 0);
  }

  /** Loads the bodies of a frame, and then their images, so that a smaller count leaves the images out. */
  load(film, k, colouring) {
    this.loadEdges(film.windowAt(k).map((side) => side / 2));
    const { particles } = film, images = film.images[k], box = film.boxAt(k), size = 13;
    this.bodies = particles + images.length / 4;
    const numbers = new Float32Array(size * this.bodies);
    for (let i = 0; i < particles; ++i) {
      const { centre, turn } = solidPose(film, k, i);
      const paint = film.overlapping[k].has(i) ? overlapRed : colouring.of(film, k, i);
      numbers.set([...centre, ...turn, ...film.axesOf(i), ...components(paint)], size * i);
    }
    for (let n = 0; n < images.length / 4; ++n) {
      const [i, ...shift] = images.slice(4 * n, 4 * n + 4), at = size * (particles + n);
      numbers.copyWithin(at, size * i, size * (i + 1));
      shift.forEach((boxes, axis) => { numbers[at + axis] += boxes * box[axis]; });
    }
    this.fill(this.solids, numbers, [3, 4, 3, 3]);
  }

  /** `half` has half the sides of the part of the box that is shown. */
  loadEdges(half) {
    const edges = [0, 1, 2].flatMap((axis) => [[-1, -1], [-1, 1], [1, -1], [1, 1]].map((signs) => {
      const end = (sign) => half.map((side, k) => side * (k === axis ? sign : signs[(k - axis + 3) % 3 - 1]));
      return [...end(-1), ...end(1)];
    }));
    this.half = half;
    this.fill(this.edges, edges.flat(), [3, 3]);
  }

  /**
   * `view` is a rotation, column after column; `middle` is the point in the middle of the window, `scale` is pixels
   * per length, and `depth` is the farthest depth.
   */
  draw(width, height, { view, middle, scale, depth, count, cut, slice, page, ink }) {
    const { gl, canvas } = this;
    canvas.width = width;
    canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    for (const [kind, instances] of [[this.solids, count], [this.edges, 12]]) {
      gl.useProgram(kind.program);
      gl.bindVertexArray(kind.array);
      gl.uniformMatrix3fv(kind.place('view'), false, view);
      gl.uniform4f(kind.place('window'), ...middle, 2 * scale / width, 1 / depth);
      gl.uniform1f(kind.place('pixel'), 1 / scale);
      gl.uniform3fv(kind.place('box'), this.half);
      gl.uniform1i(kind.place('cut'), cut);
      gl.uniform4fv(kind.place('slice'), slice);
      gl.uniform3fv(kind.place('page'), page);
      gl.uniform3fv(kind.place('ink'), ink);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, instances);
    }
  }
}

// The picture

const times = (p, q) => [0, 1, 2].flatMap((column) => [0, 1, 2].map((row) =>
  p[row] * q[3 * column] + p[3 + row] * q[3 * column + 1] + p[6 + row] * q[3 * column + 2]));

/** A rotation about x or y of the view. */
function turnAbout(axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return axis === 'x' ? [1, 0, 0, 0, c, s, 0, -s, c] : [c, 0, -s, 0, 1, 0, s, 0, c];
}

// z points upwards; the box is seen from the front right, from above.
const firstView = times(turnAbout('x', 0.42), times(turnAbout('y', -0.6), [1, 0, 0, 0, 0, -1, 0, 1, 0]));

/** The red, green and blue, from 0 to 1, of a colour of the style sheet. */
const channels = (name) => components(cssColour(name)).map((value) => value / 255);

/** A player of bodies in a box. */
class Player extends FilmPlayer {
  constructor() {
    super(solidColourings);
    this.canvas.style.touchAction = 'none';
    byId('slice-axis').addEventListener('change', () => this.draw());
    for (const id of ['slice', 'cut', 'images']) byId(id).addEventListener('input', () => this.draw());
    try {
      this.painter = new SolidPainter();
    } catch {
      this.painter = null;
    }
  }

  load(data, texts) {
    if (this.painter) return super.load(data, texts);
    super.load(null, { note: 'The picture needs WebGL 2, which this browser does not offer; all figures are below.' });
  }

  get imagesText() {
    const { film } = this;
    return film.isWhole && film.frames === 1
      ? `; with their images, ${film.particles + film.images[0].length / 4} bodies meet the box` : '';
  }

  // The view is a rotation, the point in the middle, and the zoom. With zoom 1 the box fits in every rotation.

  reset() {
    this.view = { turn: firstView, x: 0, y: 0, zoom: 1 };
    this.draw();
  }

  turn(right, down) {
    const { turn } = this.view;
    this.view.turn = times(turnAbout('x', down), times(turnAbout('y', right), turn));
    this.draw();
  }

  /** Pixels of the page per unit of length. */
  get scale() { return 0.5 * this.canvas.clientWidth / this.reach * this.view.zoom; }
  get reach() { return 0.515 * Math.hypot(...this.film.windowAt(this.k)); }

  look(x, y, zoom) {
    const inside = (value) => Math.min(Math.max(value, -this.reach), this.reach);
    Object.assign(this.view, { x: inside(x), y: inside(y), zoom });
    this.draw();
  }

  /** Zooms so that the point under (px, py) stays where it is. */
  zoomAt(px, py, factor) {
    const zoom = Math.min(Math.max(this.view.zoom * factor, 0.5), 40);
    const moved = (1 - this.view.zoom / zoom) / this.scale;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.look(this.view.x + (px - width / 2) * moved, this.view.y - (py - height / 2) * moved, zoom);
  }

  drag(px, py, { shiftKey }) {
    if (shiftKey) return this.look(this.view.x - px / this.scale, this.view.y + py / this.scale, this.view.zoom);
    this.turn(px * 0.01, py * 0.01);
  }

  get stepKeys() { return 'comma and full stop'; }

  get help() {
    return 'arrows turn, Shift with arrows moves, + − zoom, 0 shows the first view. Dragging turns the view, with Shift it moves ' +
      'it; two fingers or the wheel, while the picture has the focus, zoom.';
  }

  keys(shift) {
    const go = (x, y) => () => shift ? this.drag(-40 * x, -40 * y, { shiftKey: true }) : this.turn(0.12 * x, 0.12 * y);
    return { ...this.timeKeys(), ',': () => this.step(-1), '.': () => this.step(1),
             ArrowLeft: go(-1, 0), ArrowRight: go(1, 0), ArrowUp: go(0, -1), ArrowDown: go(0, 1) };
  }

  // Drawing

  /** The normal of the slice in the box, and the distance along it up to which bodies are shown. */
  get slice() {
    const { turn } = this.view, choice = byId('slice-axis').value;
    const normal = choice === 'view' ? [turn[2], turn[5], turn[8]] : ['x', 'y', 'z'].map((axis) => axis === choice ? 1 : 0);
    const half = this.film.windowAt(this.k).reduce((sum, side, k) => sum + 0.5 * side * Math.abs(normal[k]), 0);
    const share = Number(byId('slice').value);
    // At the end of the slider nothing is cut, not even bodies that stick out of the box.
    return [...normal, share === 1 ? 10 * this.depth : (2 * share - 1) * half];
  }

  /** A depth beyond everything visible. */
  get depth() { return 2 * (Math.hypot(...this.film.boxAt(this.k)) + this.film.longest); }

  /** Draws at most once per frame of the screen. */
  draw() {
    this.tell();
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = null;
      this.paint();
    });
  }

  paint() {
    const { film, k, canvas, painter, view } = this;
    const content = [film, k, this.colouring, isDark()];
    if (content.some((part, n) => part !== this.painted?.[n])) painter.load(film, k, this.colourings[this.colouring]);
    this.painted = content;
    const side = canvas.clientWidth;
    const ctx = prepareCanvas(canvas, side, side);
    const fine = Math.max(2, devicePixelRatio);  // two points per pixel make edges smooth
    painter.draw(fine * side, fine * side, {
      view: view.turn, middle: [view.x, view.y], scale: fine * this.scale, depth: this.depth,
      count: byId('images').checked ? painter.bodies : film.particles,
      cut: byId('cut').checked, slice: this.slice, page: channels('--plot'), ink: channels('--ink'),
    });
    ctx.imageSmoothingQuality = 'high';
    ctx.drawImage(painter.canvas, 0, 0, canvas.width, canvas.height);
    this.drawAxes(ctx);
  }

  /** Draws the directions of x, y and z. */
  drawAxes(ctx) {
    const { turn } = this.view, length = 22 * devicePixelRatio, middle = 38 * devicePixelRatio;
    ctx.font = `600 ${13 * devicePixelRatio}px system-ui, sans-serif`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    ctx.lineWidth = 2 * devicePixelRatio;
    ['x', 'y', 'z'].forEach((axis, k) => {
      const x = turn[3 * k] * length, y = -turn[3 * k + 1] * length;
      ctx.strokeStyle = ctx.fillStyle = cssColour('--ink');
      ctx.beginPath();
      ctx.moveTo(middle, ctx.canvas.height - middle);
      ctx.lineTo(middle + x, ctx.canvas.height - middle + y);
      ctx.stroke();
      ctx.fillText(axis, middle + 1.45 * x, ctx.canvas.height - middle + 1.45 * y);
    });
  }
}
