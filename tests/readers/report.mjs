// Opens a report in a headless Chromium without scripts and without network: node report.mjs PAGE PICTURE
//
// Nothing but the page may be asked for and the console must stay silent; figures must have a name and words for those
// who do not see them, and all must lie within the width of the window. Writes a picture of the page, and tells how
// many figures, tables and pictures there are.
import { createRequire } from 'node:module';
import { strict as assert } from 'node:assert';
import { join, resolve } from 'node:path';

const require = createRequire(join(resolve(process.env.PHYTOMER_PLAYWRIGHT ?? '.'), 'x.js'));
const { chromium } = require('playwright-core');
const [file, picture] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: ['--no-sandbox', '--disable-gpu'] });
const context = await browser.newContext({ javaScriptEnabled: false, offline: true, viewport: { width: 900, height: 1000 } });
const page = await context.newPage();
const heard = [];
const asked = [];
page.on('console', (message) => heard.push(message.text()));
page.on('requestfailed', (request) => heard.push(request.url()));
page.on('request', (request) => asked.push(request.url()));
await page.goto(`file://${resolve(file)}`);
assert.deepEqual(heard, []);
const beyond = asked.filter((url) => !url.startsWith('data:'));
assert.equal(beyond.length, 1, beyond.join(' '));

const figures = await page.locator('svg[role=img]').all();
for (const figure of figures) {
  assert.ok((await figure.locator('> title').textContent()).length > 5);
  assert.ok((await figure.locator('> desc').textContent()).length > 20);
  const box = await figure.boundingBox();
  assert.ok(box.width > 300 && box.x >= 0 && box.x + box.width <= 900, JSON.stringify(box));
}
const pictures = await page.locator('img').all();
for (const one of pictures) {
  assert.ok((await one.getAttribute('alt')).length > 10);
  assert.ok((await one.boundingBox()).height > 100, 'a picture within the page is shown');
}
// The policy keeps out what a page must not have, and the numbers open without a script.
await page.locator('summary').first().click();
assert.ok(await page.locator('details[open] pre').first().isVisible());
await page.screenshot({ path: picture, fullPage: true });
await page.pdf({ path: `${picture}.pdf`, format: 'A4' });
const tables = await page.locator('figure.table table').count();
console.log(JSON.stringify({ figures: figures.length, pictures: pictures.length, tables }));
await browser.close();
