(function () {
  'use strict';
  const section = document.getElementById('replay');
  const $ = (name) => section.querySelector('.' + name);
  const said = $('said'), canvas = section.querySelector('canvas');
  const run = JSON.parse(section.querySelector('script.run').textContent);
  const bytes = Uint8Array.from(atob(run.frames), (c) => c.charCodeAt(0));
  const data = new Float32Array(bytes.buffer);
  const joints = run.joints.length, columns = 25 + joints + 7 * run.bodies;  // as add_frame in replay_page.cpp
  const kPhases = ['stands', 'starts', 'walks', 'ends'];

  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: true, preserveDrawingBuffer: true });
  } catch (error) {
    said.textContent = 'This browser has no WebGL: no 3D replay.';
    return;
  }
  renderer.gammaOutput = true;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xe9edf1);
  scene.fog = new THREE.Fog(0xe9edf1, 3, 14);
  const camera = new THREE.PerspectiveCamera(30, 1.78, 0.02, 60);
  camera.up.set(0, 0, 1);

  scene.add(new THREE.HemisphereLight(0xffffff, 0xb9bfc6, 0.75));
  const sun = new THREE.DirectionalLight(0xfff4e6, 0.7);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.radius = 4;
  const reach = 1.6 * run.height;
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 8 * reach });
  scene.add(sun, sun.target);
  const sunward = new THREE.Vector3(1.5, -1.05, 2.4).normalize();

  const floor = (function () {
    const tile = document.createElement('canvas');
    tile.width = tile.height = 256;
    const pen = tile.getContext('2d');
    const shades = ['#d9dde2', '#d2d7dd'];
    for (let i = 0; i < 4; ++i) {
      pen.fillStyle = shades[((i & 1) + (i >> 1)) % 2];
      pen.fillRect(128 * (i & 1), 128 * (i >> 1), 128, 128);
    }
    const texture = new THREE.CanvasTexture(tile);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.repeat.set(200, 200);
    texture.anisotropy = 8;
    texture.encoding = THREE.sRGBEncoding;
    const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(40, 40), new THREE.MeshStandardMaterial({ map: texture, roughness: 0.95, emissive: 0xffffff, emissiveMap: texture, emissiveIntensity: 0.3 }));
    mesh.receiveShadow = true;
    return mesh;
  })();
  scene.add(floor);

  const air = run.air;
  if (air) {
    const linear = (rgb) => new THREE.Color(...rgb).convertSRGBToLinear();
    floor.visible = !!air.floor;
    if (air.floor) {
      floor.material.color.copy(linear(air.floor));
      floor.material.emissive.copy(linear(air.floor));
    }
    scene.background = linear(air.sky);
    scene.fog = null;
    for (const light of air.lights) {
      if (light.sun) {
        if (light.shadows) sunward.set(...light.toward).normalize().negate();
        continue;
      }
      const lamp = new THREE.PointLight(linear(light.rgb), 0.6, light.range);
      lamp.position.set(...light.at);
      scene.add(lamp);
    }
  }

  // Grid points on the box, projected onto spheres around an inner box.
  function roundBox(size, round) {
    const geometry = new THREE.BoxBufferGeometry(size[0], size[1], size[2], 8, 8, 8);
    const at = geometry.attributes.position, normal = geometry.attributes.normal;
    const half = size.map((s) => s / 2), r = Math.min(round, 0.98 * Math.min(...half));
    if (!(r > 0)) return geometry;
    const p = new THREE.Vector3(), inner = new THREE.Vector3();
    const spread = (v, h) => {  // lines lie in the corners' arcs
      const k = Math.round(4 * v / h);
      if (Math.abs(k) === 4) return v;
      return Math.sign(k) * (h - r * (1 - Math.tan(Math.PI / 4 * Math.abs(k) / 4)));
    };
    for (let i = 0; i < at.count; ++i) {
      p.fromBufferAttribute(at, i);
      p.set(spread(p.x, half[0]), spread(p.y, half[1]), spread(p.z, half[2]));
      inner.set(...[p.x, p.y, p.z].map((v, k) => Math.max(r - half[k], Math.min(half[k] - r, v))));
      const n = p.clone().sub(inner);
      if (n.lengthSq() < 1e-12) n.fromBufferAttribute(normal, i);
      n.normalize();
      inner.addScaledVector(n, r);
      at.setXYZ(i, inner.x, inner.y, inner.z);
      normal.setXYZ(i, n.x, n.y, n.z);
    }
    return geometry;
  }
  const bufferOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  function triangles(item) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(bufferOf(item.points)), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bufferOf(item.corners)), 1));
    geometry.computeVertexNormals();
    return geometry;
  }
  function geometryOf(item) {
    const s = item.size;
    if (item.shape === 'box') return roundBox(s, item.round);
    if (item.shape === 'sphere') return new THREE.SphereBufferGeometry(s[0], 32, 20);
    if (item.shape === 'plane') return new THREE.PlaneBufferGeometry(s[0], s[1]);
    if (item.shape === 'cylinder') return new THREE.CylinderBufferGeometry(s[0], s[0], s[2], 32).rotateX(Math.PI / 2);
    if (item.shape === 'triangles') return triangles(item);
    const profile = [];
    for (let i = 0; i <= 24; ++i) {
      const a = -Math.PI / 2 + Math.PI * i / 24;
      profile.push(new THREE.Vector2(Math.max(0, s[0] * Math.cos(a)), s[0] * Math.sin(a) + (i < 12 ? -1 : 1) * s[2] / 2));
    }
    return new THREE.LatheBufferGeometry(profile, 24).rotateX(Math.PI / 2);
  }
  const colour = (rgb) => new THREE.Color(rgb[0], rgb[1], rgb[2]).convertSRGBToLinear();

  const nodes = [new THREE.Group()];
  scene.add(nodes[0]);
  const axes = [];
  for (const joint of run.joints) {
    const node = new THREE.Group();
    node.position.set(...joint.at);
    nodes[joint.parent].add(node);
    nodes.push(node);
    axes.push(new THREE.Vector3(...joint.axis));
  }
  const bodies = Array.from({ length: run.bodies }, () => new THREE.Group());
  if (bodies.length) scene.add(...bodies);
  for (const item of run.items) {
    const material = new THREE.MeshStandardMaterial({
      color: colour(item.rgba), emissive: colour(item.glow), roughness: item.rough, metalness: item.metal,
      transparent: item.rgba[3] < 0.99, opacity: item.rgba[3] });
    const mesh = new THREE.Mesh(geometryOf(item), material);
    mesh.position.set(...item.pose.slice(0, 3));
    mesh.quaternion.set(...item.pose.slice(3));
    mesh.castShadow = mesh.receiveShadow = true;
    (item.node >= 0 ? nodes[item.node] : item.body >= 0 ? bodies[item.body] : scene).add(mesh);
  }

  const marks = new THREE.Group();
  scene.add(marks);
  const plain = (hex) => new THREE.MeshBasicMaterial({ color: hex });
  const unit = run.height / 0.45;
  const com = new THREE.Mesh(new THREE.SphereBufferGeometry(0.011 * unit, 20, 14), plain(0xf2c01e));
  com.material.depthTest = false;
  com.renderOrder = 2;
  const disc = (hex, outer, inner, height) => {
    const mesh = new THREE.Mesh(new THREE.RingBufferGeometry(inner * unit, outer * unit, 28), plain(hex));
    mesh.position.z = height;
    return mesh;
  };
  const zmp = disc(0xd63a2a, 0.0065, 0.0001, 0.004), planned = disc(0x1d74d6, 0.0115, 0.0075, 0.0035);
  const forces = [0, 1].map(() => new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 1, 0x2a9d57));
  const footprints = [0, 1, 2, 3].map((i) => {
    const sole = run.soles[0] || [-0.05, -0.03, 0.05, 0.03];
    const line = new THREE.LineLoop(
      new THREE.BufferGeometry().setFromPoints([[0, 1], [2, 1], [2, 3], [0, 3]].map((k) => new THREE.Vector3(sole[k[0]], sole[k[1]], 0.002))),
      new THREE.LineBasicMaterial({ color: 0x1d74d6 }));
    return line;
  });
  marks.add(com, zmp, planned, ...forces, ...footprints);

  const turn = { azimuth: -0.62, elevation: 0.24, distance: 3.0 * run.height };
  const target = new THREE.Vector3(0, 0, 0.48 * run.height);
  const q = new THREE.Quaternion(), next = new THREE.Quaternion();
  const begin = run.count ? data[0] : 0, end = run.count ? data[(run.count - 1) * columns] : 0;
  let time = begin, playing = true, dirty = true;

  function indexAt(t) {
    let low = 0, high = run.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (data[middle * columns] <= t) low = middle; else high = middle - 1;
    }
    return low;
  }
  function pose() {
    if (!run.count) return;
    const i = indexAt(time), a = i * columns, b = Math.min(i + 1, run.count - 1) * columns;
    const share = b > a ? Math.min(1, Math.max(0, (time - data[a]) / (data[b] - data[a]))) : 0;
    const mix = (k) => data[a + k] + share * (data[b + k] - data[a + k]);
    nodes[0].position.set(mix(1), mix(2), mix(3));
    q.set(data[a + 4], data[a + 5], data[a + 6], data[a + 7]);
    next.set(data[b + 4], data[b + 5], data[b + 6], data[b + 7]);
    nodes[0].quaternion.copy(q.slerp(next, share));
    for (let j = 0; j < joints; ++j) nodes[j + 1].quaternion.setFromAxisAngle(axes[j], mix(25 + j));
    bodies.forEach((body, k) => {
      const c = 25 + joints + 7 * k;
      body.position.set(mix(c), mix(c + 1), mix(c + 2));
      q.fromArray(data, a + c + 3);
      next.fromArray(data, b + c + 3);
      body.quaternion.copy(q.slerp(next, share));
    });
    com.visible = !isNaN(data[a + 10]);
    com.position.set(mix(10), mix(11), mix(12));
    zmp.visible = !isNaN(data[a + 13]);
    zmp.position.x = data[a + 13];
    zmp.position.y = data[a + 14];
    planned.visible = !isNaN(data[a + 15]);
    planned.position.x = data[a + 15];
    planned.position.y = data[a + 16];
    forces.forEach((arrow, side) => {
      const k = a + 17 + 4 * side, length = data[k + 3] / run.weight * run.height / 3;
      arrow.visible = length > 0.01;
      if (!arrow.visible) return;
      arrow.position.set(data[k], data[k + 1], data[k + 2]);
      arrow.setLength(length, 0.3 * length, 0.12 * length);
    });
    footprints.forEach((line, k) => {
      const step = run.footsteps[i][k];
      line.visible = !!step;
      if (!step) return;
      line.material.color.set(step[0] === 0 ? 0x1d74d6 : 0xcc4d9e);
      line.position.set(step[1], step[2], 0);
      line.rotation.z = step[3];
    });
    said.textContent = run.name + '  ' + time.toFixed(2) + ' s  ' + (kPhases[data[a + 8]] || '') +
      (data[a + 8] > 0 ? '  state ' + data[a + 9] : '');
  }
  function draw() {
    pose();
    const body = nodes[0].position;
    if ($('follow').checked) target.set(body.x, body.y, 0.48 * run.height);
    const flat = turn.distance * Math.cos(turn.elevation);
    camera.position.set(target.x + flat * Math.cos(turn.azimuth), target.y + flat * Math.sin(turn.azimuth), target.z + turn.distance * Math.sin(turn.elevation));
    camera.lookAt(target);
    // The floor moves in whole tiles: it seems endless.
    floor.position.set(Math.round(body.x / 0.2) * 0.2, Math.round(body.y / 0.2) * 0.2, 0);
    sun.target.position.copy(body);
    sun.position.copy(body).addScaledVector(sunward, 3 * reach);
    marks.visible = $('marks').checked;
    renderer.render(scene, camera);
    dirty = false;
  }
  function fit() {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width || !height) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    dirty = true;
  }
  function seek(t) {
    time = Math.min(end, Math.max(begin, t));
    $('time').value = time;
    dirty = true;
  }
  function setPlaying(value) {
    playing = value;
    $('play').textContent = playing ? 'Pause' : 'Play';
    if (playing && time >= end) seek(begin);
  }

  let held = null;
  canvas.addEventListener('pointerdown', (event) => { held = event; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener('pointerup', () => { held = null; });
  canvas.addEventListener('pointercancel', () => { held = null; });
  canvas.addEventListener('pointermove', (event) => {
    if (!held) return;
    turn.azimuth -= (event.clientX - held.clientX) * 0.008;
    turn.elevation = Math.min(1.5, Math.max(0.01, turn.elevation + (event.clientY - held.clientY) * 0.006));
    held = event;
    dirty = true;
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    turn.distance = Math.min(20, Math.max(0.3 * run.height, turn.distance * Math.exp(event.deltaY * 0.001)));
    dirty = true;
  }, { passive: false });
  $('time').min = begin;
  $('time').max = end;
  $('time').addEventListener('input', () => { setPlaying(false); seek(Number($('time').value)); });
  $('play').addEventListener('click', () => setPlaying(!playing));
  for (const name of ['marks', 'follow']) $(name).addEventListener('change', () => { dirty = true; });
  window.addEventListener('resize', fit);
  fit();

  let last = null;
  function frame(now) {
    if (playing && last !== null) {
      seek(time + Math.min(0.1, (now - last) / 1000) * Number($('speed').value));
      if (time >= end) setPlaying(false);
    }
    last = now;
    if (dirty) draw();
    requestAnimationFrame(frame);
  }
  // For users' scripts.
  window.verpReplay = { begin: begin, end: end, seek: (t) => { setPlaying(false); seek(t); draw(); }, time: () => time, turn: turn, draw: draw };
  draw();
  requestAnimationFrame(frame);
})();
