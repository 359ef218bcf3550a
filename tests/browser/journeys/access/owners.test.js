// A server whose scenes have owners: one user shares a scene from the editor, and another finds it.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { journeys } from '../../support/journey.js';
import { Program } from '../../support/program.js';

journeys('owners', (stage) => {
  it('share a scene where it is shared as a link, and go on editing it', { timeout: 90_000 }, async () => {
    const program = await Program.start(undefined, ['--owners', '--trust-proxy', '127.0.0.1']);
    // The proxy before the server names the user.
    const visit = async (name) => {
      const extraHTTPHeaders = { 'X-Forwarded-User': name };
      const e = await stage.visit(new URL('/scenes/demo-crossing', program.url).href, { extraHTTPHeaders });
      await e.begin();
      return e;
    };
    try {
      const anna = await visit('anna');
      const access = anna.page.getByRole('radiogroup', { name: 'Access on this server' });
      const share = async () => {
        await anna.page.locator('[data-action="share"]').click();
        await anna.until(() => document.querySelector('.share input')?.value.startsWith('http'));
      };
      await share();
      assert.equal(await access.count(), 0, 'an example has no owner');
      await anna.key('Escape');

      await anna.key('Control+s');
      await anna.until(() => /Saved as/.test(document.querySelector('.toast')?.textContent));
      await anna.settled();
      const found = async (e) => (await e.get('/v1/scenes')).scenes.filter((s) => s.owner === 'anna');
      const [{ id }] = await found(anna);
      await share();
      const chosen = () => access.locator('[aria-checked="true"]').innerText();
      assert.equal(await chosen(), 'Owner only');
      assert.match(await anna.text('.share'), /Owner: anna/);
      assert.match(await anna.text('.share .dfoot'), /^Anyone with the link can view the scene/);
      await access.getByRole('radio', { name: 'Everyone can view' }).click();
      await anna.until(
        () => document.querySelector('.share [aria-checked="true"]').textContent === 'Everyone can view',
      );
      await anna.picture('access');
      await anna.key('Escape');

      // The version of the server is that of the page: the next change is no conflict.
      const [{ id: someone }] = (await anna.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 0);
      await anna.choose(someone);
      const saved = anna.page.waitForResponse((r) => r.request().method() === 'PUT');
      await anna.type('goal-time', '6.5');
      assert.equal((await saved).status(), 200);

      const maria = await visit('maria');
      assert.deepEqual(
        (await found(maria)).map((s) => [s.id, s.shared]),
        [[id, 'read']],
      );

      // She may view it: the page says whose it is, and refuses changes; her copy is her own.
      await maria.page.goto(new URL(`/?scene=${id}`, program.url).href);
      await maria.ready();
      await maria.until(() => document.querySelector('.banner b')?.textContent === 'Only anna can change this scene.');
      await maria.picture('view-only');
      assert.equal(await maria.text('.title small'), 'Read-only');
      await maria.page.locator('[data-action="share"]').click();
      const radios = maria.page.getByRole('radiogroup', { name: 'Access on this server' }).getByRole('radio');
      assert.equal(await radios.first().getAttribute('aria-disabled'), 'true');
      await maria.key('Escape');
      const sent = [];
      maria.page.on('response', (r) => r.request().method() === 'PUT' && sent.push(r.status()));
      await maria.begin();
      await maria.choose(someone);
      await maria.key('Delete');
      await maria.settled();
      assert.ok(
        (await maria.roadUsers()).some((u) => u.id === someone),
        'nothing is removed',
      );
      await maria.page.getByRole('button', { name: 'Make a copy' }).click();
      await maria.until(() => /Saved as/.test(document.querySelector('.toast')?.textContent));
      await maria.until(() => !document.querySelector('.banner'));
      assert.deepEqual(sent, []);
      assert.equal((await maria.get('/v1/scenes')).scenes.filter((s) => s.owner === 'maria').length, 1);
    } finally {
      await program.stop();
    }
  });
});
