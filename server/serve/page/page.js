// Keeps the page up to date. Numbers: the page is asked for again and its parts are exchanged, so that they are
// made in one place, the server, and stand here without scripts too. Pictures: each is loaded again once it is
// there. Charts: from /v1/frames.
'use strict';

const kNumbersMs = 1000, kFramesMs = 500, kPictureMs = 500;
const kHistorySeconds = 60, kMostFrames = 1200;

const frames = [];
let newest = 0;
let periodMs = null;
let settings = {};  // of the replay: what frames have that do not say otherwise

function sleep(ms) {
  return new Promise((resolve) => setTimeout(resolve, ms));
}

async function answer(path) {
  const response = await fetch(path, { cache: 'no-store' });
  if (!response.ok) throw new Error(path + ': ' + response.status);
  return response;
}

function tellConnection(lost) {
  const line = document.getElementById('connection');
  line.hidden = !lost;
  if (lost && !line.textContent) line.textContent = 'No answer since ' + new Date().toLocaleTimeString() + '.';
  if (!lost) line.textContent = '';
}

// --- numbers ---

async function refreshNumbers() {
  const text = await (await answer('/')).text();
  const fresh = new DOMParser().parseFromString(text, 'text/html');
  for (const part of document.querySelectorAll('.live')) {
    part.replaceChildren(...fresh.getElementById(part.id).childNodes);
  }
  const pictures = document.getElementById('pictures');
  const names = (root) => [...root.querySelectorAll('img')].map((image) => image.alt).join();
  const here = names(pictures), there = names(fresh.getElementById('pictures'));
  if (here === there) return;
  pictures.replaceChildren(...fresh.getElementById('pictures').childNodes);
  watchPictures();
}

// --- pictures ---

async function watchPicture(image) {
  const path = new URL(image.src).pathname;
  let shown = '';
  while (image.isConnected) {
    await sleep(kPictureMs);
    if (document.hidden) continue;
    try {
      const response = await fetch(path, { cache: 'no-store' });
      const sequence = response.headers.get('X-Herr-Sequence');
      if (!response.ok || sequence === shown) continue;
      const next = URL.createObjectURL(await response.blob());
      const before = image.src;
      image.src = next;
      await image.decode();
      if (before.startsWith('blob:')) URL.revokeObjectURL(before);
      shown = sequence;
      image.dataset.sequence = sequence;
      const caption = image.closest('figure').querySelector('.sequence');
      if (caption) caption.textContent = ', frame ' + sequence;
    } catch (error) {
      await sleep(kNumbersMs);
    }
  }
}

function watchPictures() {
  for (const image of document.querySelectorAll('#pictures img')) watchPicture(image);
}

// --- charts ---

const kColours = ['#3b82c4', '#e08a2e', '#4aa564', '#c4504b', '#8b6cc0', '#96705f', '#d27fb8', '#7f8c8d', '#b7b13c',
  '#39b0bd', '#5568d3', '#b3572b', '#2f7f73', '#a53f76', '#66752e', '#404a57'];

function lines(names, options) {
  return names.map((name, i) => ({
    label: name, data: [], borderColor: kColours[i % kColours.length], backgroundColor: kColours[i % kColours.length],
    borderWidth: 1.5, pointRadius: 0, ...options,
  }));
}

function chart(id, datasets, scales, options) {
  const quiet = { color: 'rgba(136,136,136,.25)' };
  return new Chart(document.getElementById(id), {
    type: 'line',
    data: { datasets },
    options: {
      animation: false, normalized: true, responsive: true, maintainAspectRatio: false, parsing: false,
      interaction: { mode: 'nearest', axis: 'x', intersect: false },
      plugins: { legend: { labels: { boxWidth: 10, color: '#888' } } },
      scales: {
        x: { type: 'linear', grid: quiet, ticks: { color: '#888', maxRotation: 0 },
          title: { display: true, text: 'seconds since the start', color: '#888' } },
        ...Object.fromEntries(Object.entries(scales).map(([name, scale]) => [name, {
          beginAtZero: true, grid: name === 'y' ? quiet : { display: false }, ticks: { color: '#888' }, ...scale }])),
      },
      ...options,
    },
  });
}

const charts = {};

function makeCharts() {
  document.getElementById('charts').hidden = false;
  charts.frame = chart('chart-frame', [
    ...lines(['frame'], {}),
    { label: 'work', data: [], showLine: false, pointRadius: 3, borderColor: '#d22', backgroundColor: '#d22' },
    { label: 'machine', data: [], showLine: false, pointRadius: 3, borderColor: '#e90', backgroundColor: '#e90' },
    { label: 'both', data: [], showLine: false, pointRadius: 3, borderColor: '#93c', backgroundColor: '#93c' },
    { label: 'display period', data: [], borderColor: '#888', borderDash: [6, 4], borderWidth: 1, pointRadius: 0 },
  ], { y: {} });
  charts.load = chart('chart-load', [
    { ...lines(['CPU'], {})[0], yAxisID: 'y' },
    { ...lines(['', 'preemptions'], { stepped: true })[1], yAxisID: 'right' },
  ], { y: {}, right: { position: 'right' } });
  charts.stages = chart('chart-stages', [], { y: { stacked: true } });
  charts.quality = chart('chart-quality', [
    { ...lines(['polar width'], { stepped: true })[0], yAxisID: 'y' },
    { ...lines(['', 'light samples'], { stepped: true })[1], yAxisID: 'right' },
  ], { y: {}, right: { position: 'right' } });
  charts.ages = chart('chart-ages', lines(['pose', 'gaze', 'camera', 'motion to photon'], {}), { y: {} });
}

function points(value) {
  const found = [];
  for (const frame of frames) {
    const y = value(frame);
    if (y !== null && y !== undefined) found.push({ x: frame.finished_s, y });
  }
  return found;
}

// Stages that took time in some frame shown here, in the order of the frame.
function stageNames() {
  const names = Object.keys(frames[0].stages_ms);
  return names.filter((name) => frames.some((frame) => frame.stages_ms[name] > 0));
}

function drawCharts() {
  if (frames.length === 0) return;
  const [frame, work, machine, both, period] = charts.frame.data.datasets;
  frame.data = points((f) => f.frame_ms);
  work.data = points((f) => (f.cause === 'work' ? f.frame_ms : null));
  machine.data = points((f) => (f.cause === 'machine' ? f.frame_ms : null));
  both.data = points((f) => (f.cause === 'both' ? f.frame_ms : null));
  const [cpu, preemptions] = charts.load.data.datasets;
  cpu.data = points((f) => f.cpu_ms);
  preemptions.data = points((f) => f.preemptions);
  const ends = [frames[0], frames[frames.length - 1]];
  period.data = periodMs === null ? [] : ends.map((f) => ({ x: f.finished_s, y: periodMs }));
  const names = stageNames();
  if (charts.stages.data.datasets.map((set) => set.label).join() !== names.map((n) => n.replaceAll('_', ' ')).join()) {
    charts.stages.data.datasets = lines(names.map((n) => n.replaceAll('_', ' ')), { fill: true, borderWidth: 0 });
  }
  names.forEach((name, i) => { charts.stages.data.datasets[i].data = points((f) => f.stages_ms[name]); });
  const [width, samples] = charts.quality.data.datasets;
  width.data = points((f) => 2 * (f.polar_width ?? settings.polar_width_per_eye));
  samples.data = points((f) => f.light_samples ?? settings.light_samples);
  const ages = charts.ages.data.datasets;
  ['pose_age_ms', 'gaze_age_ms', 'camera_age_ms', 'motion_to_photon_ms'].forEach((key, i) => {
    ages[i].data = points((f) => f[key]);
  });
  for (const one of Object.values(charts)) one.update('none');
}

async function refreshFrames() {
  if (periodMs === null) {
    const status = await (await answer('/v1/status')).json();
    if (!status.replay) return;
    periodMs = status.replay.period_ms;
    settings = status.settings;
  }
  const reply = await (await answer('/v1/frames?since=' + newest)).json();
  // Another run of the server: its frames begin at 1 again.
  if (reply.newest !== null && reply.newest < newest) {
    frames.length = 0;
    newest = 0;
    periodMs = null;
    return;
  }
  frames.push(...reply.frames);
  if (frames.length === 0) return;
  const last = frames[frames.length - 1];
  newest = last.sequence;
  while (frames.length > kMostFrames || frames[0].finished_s < last.finished_s - kHistorySeconds) frames.shift();
  if (!document.hidden) drawCharts();
}

async function repeat(work, ms) {
  for (;;) {
    try {
      await work();
      tellConnection(false);
    } catch (error) {
      tellConnection(true);
    }
    await sleep(document.hidden ? 4 * ms : ms);
  }
}

makeCharts();
watchPictures();
repeat(refreshNumbers, kNumbersMs);
repeat(refreshFrames, kFramesMs);
