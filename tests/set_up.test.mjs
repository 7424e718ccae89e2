// What a command does on a machine that lacks what it needs.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { planInstallation, refuseNode } from './set_up.mjs';
import { root as project } from './steps.mjs';

const range = '^20.19.0 || >=22.12.0';
const root = { isRoot: true, hasApt: true, hasSudo: false, maySudo: false };
const user = { isRoot: false, hasApt: true, hasSudo: true, maySudo: false };
const update = ['apt-get', 'update'];
const installation = (...packages) => ['apt-get', 'install', '-y', '--no-install-recommends', ...packages];

test('versions of Node that Vite refuses are refused, with what is needed', () => {
  for (const version of ['18.20.4', '20.18.3', '21.7.3', '22.11.0'])
    assert.match(refuseNode(version, range), new RegExp(`${version} .*\\^20\\.19\\.0 \\|\\| >=22\\.12\\.0`));
  for (const version of ['20.19.0', '20.20.2', '22.12.0', '23.0.0', '24.1.0']) assert.equal(refuseNode(version, range), undefined);
});

test('root installs tools by apt-get, then the npm packages', () => {
  assert.deepEqual(planInstallation(['the npm packages', 'Eigen', 'CMake'], 'start', root), {
    commands: [update, installation('libeigen3-dev', 'cmake'), ['npm', 'ci']],
  });
});

test('a user is told of npm run setup, which uses sudo', () => {
  const { commands, refusal } = planInstallation(['Eigen', 'CMake'], 'start', user);
  assert.equal(commands, undefined);
  assert.match(refusal, /Eigen, CMake.*npm run setup -- start/);
  assert.deepEqual(planInstallation(['Eigen'], 'start', { ...user, maySudo: true }), {
    commands: [
      ['sudo', ...update],
      ['sudo', ...installation('libeigen3-dev')],
    ],
  });
});

test('npm packages need no sudo', () => {
  assert.deepEqual(planInstallation(['the npm packages'], 'bench', user), { commands: [['npm', 'ci']] });
});

test('without apt-get, or without sudo, the tools to install are named', () => {
  for (const machine of [
    { ...root, hasApt: false },
    { ...user, hasSudo: false, maySudo: true },
  ])
    assert.match(
      planInstallation(['Emscripten', 'the npm packages'], 'build', machine).refusal,
      /Emscripten\. .*apt-get install .*emscripten/,
    );
});

test('CMake without Catch2: ctest fails and says so', () => {
  const call = (command, ...args) => spawnSync(command, args, { cwd: project, encoding: 'utf8' });
  assert.match(call('cmake', '-B', 'build/no-catch2', '-DCMAKE_DISABLE_FIND_PACKAGE_Catch2=ON').stderr, /Catch2 not found/);
  const { status, stdout } = call('ctest', '--test-dir', 'build/no-catch2');
  assert.notEqual(status, 0);
  assert.match(stdout, /catch2_missing .*Failed/);
});
