// SPDX-License-Identifier: MIT
// Makes the replay page of all that it needs, and a C++ source that holds it: node build.mjs OUTPUT.cpp
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

/** A source and all that it imports, as one script. */
async function bundle(source) {
  const { outputFiles } = await build({ entryPoints: [join(here, source)], bundle: true, minify: true, write: false, format: "iife", target: "es2022",
                                        charset: "utf8", legalComments: "none", platform: "browser", external: ["fs", "path", "module", "crypto"], logLevel: "error" });
  return outputFiles[0].text.trim();
}

const file = name => readFileSync(join(here, name), "utf8");
const main = await bundle("src/main.js"), reader = await bundle("src/reader/worker.js");
if (/<\/script|<!--/i.test(main)) throw new Error("the page's script would end early");

const hash = createHash("sha256").update(main).digest("base64");
const policy = `default-src 'none'; script-src 'sha256-${hash}' 'wasm-unsafe-eval'; worker-src blob:; style-src 'unsafe-inline'`;
const parts = { POLICY: policy, STYLE: file("style.css").replace(/\s+/g, " "), READER: gzipSync(reader, { level: 9 }).toString("base64"), MAIN: main,
                LICENSES: `Contains h5wasm:\n${file("node_modules/h5wasm/LICENSE.txt").replace(/--+/g, m => "=".repeat(m.length)).trim()}` };
const page = file("page.html").replace(/@(POLICY|STYLE|READER|MAIN|LICENSES)@/g, (_, name) => parts[name]);

/** Raw string literals that any compiler takes. */
function literals(text) {
  const pieces = [];
  for (let at = 0; at < text.length; at += 15000) pieces.push(`    R"throng(${text.slice(at, at + 15000)})throng",\n`);
  return pieces.join("");
}
writeFileSync(process.argv[2], `// SPDX-License-Identifier: MIT
// Made from tools/viewer by tools/viewer/build.mjs.
#include "tools/replay_page.h"

namespace throng::tools {

const char* const kReplayHtml[] = {
${literals(page)}    nullptr};

}  // namespace throng::tools
`);
