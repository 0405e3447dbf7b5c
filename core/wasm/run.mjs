// Prints the digests of the module given as the argument, as the native program does.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { moments, eq4 } = instance.exports;
const hex = (word) => (word >>> 0).toString(16).padStart(8, "0");
for (let frames = 1; frames <= 40; frames++) console.log(frames, hex(moments(frames)), hex(eq4(frames)));
