// Opens a page in a headless Chromium and uses it as a person would: node view.mjs PAGE FACTS
//
// FACTS is a JSON file: the numbers of components of each kind by age, as `records` has them. Counts, keys, the slider, a
// click, colours, kinds, links and the picture are tried; the console must stay silent, and nothing but the page may be
// asked for. playwright-core comes from the folder that PHYTOMER_PLAYWRIGHT names, the browser from CHROMIUM.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { strict as assert } from 'node:assert';
import { join, resolve } from 'node:path';

const require = createRequire(join(resolve(process.env.PHYTOMER_PLAYWRIGHT ?? '.'), 'x.js'));
const { chromium } = require('playwright-core');
const [file, facts] = process.argv.slice(2);
const { ages, plant } = JSON.parse(readFileSync(facts, 'utf8'));

const software = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: software });
const url = `file://${resolve(file)}`;

async function open(hash, script) {
  const context = await browser.newContext({ viewport: { width: 640, height: 420 } });
  const page = await context.newPage();
  const heard = [];
  const asked = [];
  page.on('console', (message) => heard.push(message.text()));
  page.on('pageerror', (error) => heard.push(error.message));
  page.on('request', (request) => asked.push(request.url()));
  if (script) await page.addInitScript(script);
  await page.goto(url + hash);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 60000 });
  return { page, heard, asked };
}

const drawn = (page, age) =>
  page.waitForFunction((age) => Number(document.documentElement.dataset.drawn) === age, age, { timeout: 60000 });

// The counts that the page tells, by kind.
const counts = (page) =>
  page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll('#kinds tbody tr')].map((row) => [
        row.cells[0].textContent.trim().replace(/ /g, '_'),
        Number(row.cells[1].textContent),
      ]),
    ),
  );

const row = (page) =>
  page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll('#row tr')].map((row) => [row.dataset.column, row.cells[1].dataset.value ?? row.cells[1].textContent]),
    ),
  );

function agree(found, meant, age) {
  for (const [kind, count] of Object.entries(found)) assert.equal(count, meant[kind] ?? 0, `${kind} at ${age}`);
  for (const kind of Object.keys(meant)) assert.ok(kind in found, `${kind} is told`);
}

const known = Object.keys(ages).map(Number).sort((a, b) => a - b);
const last = known.at(-1);
const middle = known[Math.floor(known.length / 2)];
const { page, heard, asked } = await open(`#age=${middle}`);

// The page begins at the seed, of which `records` may have nothing.
const first = Number(await page.getAttribute('#age', 'min'));
assert.equal(Number(await page.getAttribute('#age', 'max')), last);

// A link names its age, and every age has the counts of the table.
await drawn(page, middle);
agree(await counts(page), ages[middle], middle);
for (const age of known) {
  await page.evaluate((age) => { location.hash = `#age=${age}`; }, age);
  await page.waitForFunction((age) => Number(document.getElementById('age').value) === age, age);
  agree(await counts(page), ages[age], age);
}
await drawn(page, last);

// Keys and the slider move the age.
const age = () => page.evaluate(() => Number(document.getElementById('age').value));
await page.focus('#canvas');
await page.keyboard.press('Home');
assert.equal(await age(), first);
await page.keyboard.press('.');
assert.equal(await age(), first + 1);
await page.keyboard.press(',');
assert.equal(await age(), first);
await page.keyboard.press('End');
assert.equal(await age(), last);
await page.focus('#age');
await page.keyboard.press('ArrowLeft');
assert.equal(await age(), known.at(-2));
assert.match(await page.getAttribute('#age', 'aria-valuetext'), /^(age|tick) \d/);
const box = await page.locator('#age').boundingBox();
await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
assert.ok(Math.abs((await age()) - (first + last) / 2) < 0.08 * (last - first), `${await age()} in the middle`);
await page.evaluate((age) => { location.hash = `#age=${age}`; }, last);
await drawn(page, last);
assert.ok((await page.textContent('#live')).includes(`${last}`), 'the live region tells the age');

// Between two ages the picture is drawn too, and playing moves on.
await page.evaluate(() => { location.hash = '#age=0'; });
await page.keyboard.press('Escape');
await page.focus('#play');
await page.keyboard.press('Enter');
await page.waitForFunction(() => Number(document.getElementById('age').value) > 0.01, null, { timeout: 60000 });
await page.keyboard.press('Enter');
const stopped = await age();
await page.waitForTimeout(200);
assert.equal(await age(), stopped, 'the pause holds');
await page.evaluate((age) => { location.hash = `#age=${age}`; }, last);
await drawn(page, last);

// A click finds a row: of what the page has drawn there, or of its neighbour within a pixel or two.
const canvas = await page.locator('#canvas').boundingBox();
const hit = [canvas.width / 2, canvas.height / 2];
let found = {};
for (let step = 0; step < 60 && !('component_id' in found); step += 1) {
  const [dx, dy] = [((step % 5) - 2) * 4, (Math.floor(step / 5) - 6) * 12];
  await page.mouse.click(canvas.x + hit[0] + dx, canvas.y + hit[1] + dy);
  found = await row(page);
}
assert.ok('component_id' in found, 'a click finds a component');
const clicked = plant[last][found.component_id];
assert.ok(clicked, `${found.component_id} has a row at ${last}`);
for (const column of ['parent_id', 'axis_id', 'order', 'rank', 'birth_age', 'age', 'plant_id']) {
  if (clicked[column] !== null) assert.equal(Number(found[column]), Number(clicked[column]), column);
}
assert.equal(found.kind.replace(/ /g, '_'), clicked.kind);

// The same without a mouse: the number of a component gives its row.
const other = Object.keys(plant[last]).find((component) => component !== found.component_id);
await page.fill('#number', other);
await page.keyboard.press('Enter');
assert.equal((await row(page)).component_id, other);
// An internode and a bud have the upper side that `records` has, but for at most twice the error of where they point
// and for a degree. Three digits are shown.
const DIRECTIONS = [
  ['dir_x', 'dir_y', 'dir_z'],
  ['up_x', 'up_y', 'up_z'],
];
const sided = { internode: 0, bud: 0 };
const every = Object.keys(plant[last]).filter((_, place, all) => place % Math.ceil(all.length / 150) === 0);
for (const component of every) {
  await page.fill('#number', component);
  await page.keyboard.press('Enter');
  const shown = await row(page);
  assert.equal(shown.component_id, component);
  const meant = plant[last][component];
  const kind = ['internode', 'bud'].find((kind) => meant.kind.endsWith(kind));
  if (!kind) continue;
  const [ofHeading, ofUpper] = DIRECTIONS.map((names) =>
    Math.hypot(...names.map((name) => Number.parseFloat(shown[name]) - meant[name])),
  );
  if (kind === 'bud' && Number.isNaN(ofHeading)) continue;
  const most = 2 * ofHeading + 0.0175 + 0.005;
  assert.ok(ofUpper <= most, `${kind} ${component}: ${ofUpper} off, its direction ${ofHeading}`);
  sided[kind] += 1;
}
assert.ok(sided.internode > 20 && sided.bud > 0, JSON.stringify(sided));

await page.fill('#number', '99999999');
await page.keyboard.press('Enter');
assert.match(await page.textContent('#component-words'), /no such component/);

// Turning, coming nearer, colours and kinds change the picture.
const picture = async () => {
  await page.waitForTimeout(50);
  return (await page.locator('#canvas').screenshot()).toString('base64');
};
const before = await picture();
await page.focus('#canvas');
await page.keyboard.press('ArrowLeft');
const turned = await picture();
assert.notEqual(turned, before, 'arrows turn');
await page.keyboard.press('+');
const nearer = await picture();
assert.notEqual(nearer, turned, 'plus comes nearer');
for (const column of await page.evaluate(() => [...document.getElementById('columns').options].map((option) => option.value))) {
  await page.selectOption('#columns', column);
  await page.waitForTimeout(20);
  if (column !== '') assert.ok(await page.evaluate(() => document.querySelectorAll('#legend li').length > 0), `${column} has a legend`);
}
await page.selectOption('#columns', 'rank');
assert.notEqual(await picture(), nearer, 'a column colours');
await page.selectOption('#columns', '');
await page.locator('#kinds input').first().uncheck();
assert.notEqual(await picture(), nearer, 'a kind is off');
const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]).catch(async () => {
  await page.evaluate(() => document.querySelectorAll('details').forEach((part) => { part.open = true; }));
  return Promise.all([page.waitForEvent('download'), page.click('#save')]);
});
const saved = readFileSync(await download.path());
assert.deepEqual([...saved.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47], 'a PNG is saved');

// What a screen reader meets: every control has a name, the picture a role and words.
const unnamed = await page.evaluate(() =>
  [...document.querySelectorAll('button, input, select')]
    .filter((element) => !(element.getAttribute('aria-label') || element.labels?.length || element.textContent.trim()))
    .map((element) => element.id),
);
assert.deepEqual(unnamed, []);
assert.equal(await page.getAttribute('#canvas', 'role'), 'img');
assert.deepEqual(heard, [], 'the console is silent');
assert.equal(asked.filter((url) => !url.startsWith('blob:') && !url.startsWith('data:')).length, 1, asked.join('\n'));

// Without WebGL 2 a sentence says so, and the counts are there all the same.
const bare = await open(`#age=${last}`, () => {
  const own = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind === 'webgl2' ? null : own.call(this, kind, ...rest);
  };
});
assert.match(await bare.page.textContent('#sorry'), /no WebGL 2/);
agree(await counts(bare.page), ages[last], last);
assert.deepEqual(bare.heard, []);
await browser.close();

console.log(`${known.length} ages, component ${found.component_id} clicked, ${saved.length} bytes of PNG`);
