// An approach of two seconds at 1 kHz, the capture of two targets, and a second of free motion.
//
//     node capture.mjs MODULE.wasm

import { readFile } from "node:fs/promises";
import { ARMS, JOINTS, Robot } from "./robot.mjs";

const [proportional_gain, derivative_gain, step] = [49, 14, 0.001];
const initial = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047];
const final = [-0.524, -1.393, -0.035, 2.618, -1.393, -0.035];

const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]), {});
const robot = new Robot(instance, Float64Array);
const must = (has_result, what) => {
    if (!has_result) throw new Error(`${what}: a number is not finite, or a system is singular`);
};

robot.state.joint_angles.set(initial);
for (let k = 0; k < 2000; k++) {
    const s = k / 2000;
    const [part, rate] = [s * s * (3 - 2 * s), (6 * s * (1 - s)) / 2];
    for (let joint = 0; joint < JOINTS; joint++) {
        const way = final[joint] - initial[joint];
        robot.desired_angles[joint] = initial[joint] + part * way;
        robot.desired_rates[joint] = rate * way;
    }
    must(robot.control_step(proportional_gain, derivative_gain, step), "approach");
}
console.log("at the contact", robot.numbers);

robot.captured.set([10, 1, 0, 0.5, 0.2, 0, 0, 10, 1, 0, -0.5, 0.2, 0, 0]);
must(robot.exact_impact(), "impact");
console.log("after it", robot.numbers);
for (let arm = 0; arm < ARMS; arm++) console.log(`impulse ${arm + 1}`, robot.impulses.slice(3 * arm, 3 * arm + 3));

must(robot.merge(), "merging");
for (let k = 0; k < 1000; k++) must(robot.control_step(0, 0, step), "free motion");
console.log("a second later", robot.numbers);
