// Checks a glTF or GLB file with Khronos' own validator: node validate_gltf.mjs FILE...
// Exit code 0: no error and no warning; 1: there is one; 2: wrong usage; 77: the npm package gltf-validator is not installed (looked
// for beside this file, in the working directory, and in NODE_PATH).
import {readFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {basename, dirname, resolve, sep} from 'node:path';

const severities = ['error', 'warning', 'information', 'hint'];

function findValidator() {
  for (const base of [import.meta.url, resolve('package.json')]) {
    try {
      return createRequire(base)('gltf-validator');
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  console.error('validate_gltf: the npm package gltf-validator is not installed');
  process.exit(77);
}

async function validate(validator, file) {
  const folder = dirname(resolve(file));
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: basename(file),
    maxIssues: 1000,
    externalResourceFunction: async (uri) => {
      const path = resolve(folder, decodeURIComponent(uri));
      if (!path.startsWith(folder + sep)) throw new Error(`${uri} is outside the folder of the file`);
      return new Uint8Array(await readFile(path));
    },
  });
  const {numErrors, numWarnings, numInfos, numHints, messages} = report.issues;
  for (const issue of messages)
    console.log(`${file}: ${severities[issue.severity]}: ${issue.code} ${issue.pointer ?? ''} ${issue.message}`);
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
  return numErrors + numWarnings === 0;
}

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate_gltf.mjs FILE...');
  process.exit(2);
}
const validator = findValidator();
let clean = true;
for (const file of files) {
  try {
    clean = (await validate(validator, file)) && clean;
  } catch (error) {
    console.error(`${file}: ${error.message ?? error}`);
    clean = false;
  }
}
process.exit(clean ? 0 : 1);
