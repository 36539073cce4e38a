// Opens KTX2 files with ktx-parse and says what it found, one JSON line a file.
// Usage: node ktx_parse.mjs FOLDER_OF_NODE_MODULES FILE...; exit code 77 when the package is not there.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, ...files] = process.argv.slice(2);
const entry = join(folder, "ktx-parse", "dist", "index.mjs");
if (!existsSync(entry)) process.exit(77);
const { read } = await import(pathToFileURL(entry).href);
for (const file of files) {
    const container = read(readFileSync(file));
    const text = (value) => (typeof value === "string" ? value : new TextDecoder().decode(value)).replace(/\0+$/, "");
    console.log(JSON.stringify({
        vkFormat: container.vkFormat,
        width: container.pixelWidth,
        faces: container.faceCount,
        levels: container.levels.map((level) => level.levelData.byteLength),
        samples: container.dataFormatDescriptor[0].samples.length,
        roughness: text(container.keyValue["halfvector.roughness"]),
    }));
}
