// Compares a module with what this machine computes, bit by bit, and measures the time of a call.
//
//     node check.mjs MODULE.wasm EXPECTED double|single
//
// EXPECTED is written by src/bin/expected. Its text is put into the module's memory as it is: the arguments are in it.
// Prints the times in ns, as JSON; exits with 1 where a bit differs.

import { readFile } from "node:fs/promises";
import { ARMS, JOINTS, Memory, PARAMETERS, Robot, SIZE } from "./robot.mjs";

const [path, expected_path, scalar] = process.argv.slice(2);
const [Numbers, Bits] = scalar === "single" ? [Float32Array, Uint32Array] : [Float64Array, BigUint64Array];
const [STATES, ORDINARY, RUNS] = [1000, 800, 50];
const [GAINS, STEP] = [[49, 14], 0.001];
const [STATE, TRIPLES] = [2 * SIZE, 3 * ARMS];

const module = await WebAssembly.compile(await readFile(path));
const fail = (message) => {
    console.error(`error: ${path}: ${message}`);
    process.exit(1);
};
if (WebAssembly.Module.imports(module).length > 0) fail("it needs something of its host");
const instance = await WebAssembly.instantiate(module, {});
const functions = instance.exports;

const expected = await readFile(expected_path);
const memory = new Memory(instance);
const size = Numbers.BYTES_PER_ELEMENT;
const take = (count) => memory.bytes(count * size);
const records = memory.bytes(expected.length);
const robot = memory.bytes(functions.robot_bytes());
const merged = memory.bytes(functions.robot_bytes());
const parameters = take(PARAMETERS);
const states = take(STATES * STATE);
const results = take(STATE + 2 * TRIPLES);
const lanes = functions.lanes?.() ?? 0;
const in_lanes = lanes && {
    robots: memory.bytes(functions.robots_bytes()),
    parameters: take(PARAMETERS * lanes),
    states: take(ORDINARY * STATE),
    torques: take(ORDINARY * JOINTS),
    accelerations: take(SIZE * lanes),
};
// all memory is taken: the views stay valid
const bytes = new Uint8Array(memory.memory.buffer);
const numbers = new Numbers(memory.memory.buffer);
const bits = new Bits(memory.memory.buffer);
const index = (address) => address / size;

bytes.set(expected, records);
functions.default_parameters(parameters);
functions.new_robot(parameters, robot);

// a record: inputs, then the status of each function with its results
const INPUTS = { state: 0, torques: STATE, desired_angles: STATE + JOINTS, desired_rates: STATE + 2 * JOINTS };
INPUTS.captured = INPUTS.desired_rates + JOINTS;
const captured = 7 * ARMS;
const FOUND = [
    ["forward_dynamics", SIZE],
    ["control_step", STATE],
    ["exact_impact", STATE + 2 * TRIPLES],
    ["merge", SIZE],
];
const start_of_results = INPUTS.captured + captured;
const RECORD = FOUND.reduce((sum, [, count]) => sum + 1 + count, start_of_results);
if (expected.length !== STATES * RECORD * size) fail(`${expected_path} is of ${expected.length} bytes`);
const at = (state, input) => records + (state * RECORD + INPUTS[input]) * size;
const state_at = (state) => states + state * STATE * size;
const restore = () => {
    for (let k = 0; k < STATES; k++) bytes.copyWithin(state_at(k), at(k, "state"), at(k, "state") + STATE * size);
};

const twists = results + STATE * size;
const call = {
    forward_dynamics: (k) => functions.forward_dynamics(robot, state_at(k), at(k, "torques"), results),
    control_step: (k) =>
        functions.control_step(
            robot, state_at(k), at(k, "desired_angles"), at(k, "desired_rates"), GAINS[0], GAINS[1], STEP,
        ),
    exact_impact: (k) =>
        functions.exact_impact(robot, state_at(k), at(k, "captured"), twists, twists + TRIPLES * size),
    merge: (k) => {
        bytes.copyWithin(merged, robot, robot + functions.robot_bytes());
        return functions.merge(merged, state_at(k), at(k, "captured"))
            && functions.forward_dynamics(merged, state_at(k), at(k, "torques"), results);
    },
};
const changes_state = new Set(["control_step", "exact_impact"]);

let compared = 0;
function compare(what, k, is_done, place, found_bits) {
    const expects = numbers[place] === 1;
    if (Boolean(is_done) !== expects) fail(`${what}, state ${k}: ${is_done ? "a" : "no"} result`);
    for (let i = 0; expects && i < found_bits.length; i++) {
        if (found_bits[i] !== bits[place + 1 + i]) {
            const right = numbers[place + 1 + i];
            fail(`${what}, state ${k}, number ${i}: not the bits of ${right}`);
        }
        compared += 1;
    }
}

let place = start_of_results;
const place_of = {};
for (const [name, count] of FOUND) {
    place_of[name] = place;
    restore();
    for (let k = 0; k < STATES; k++) {
        const is_done = call[name](k);
        if (changes_state.has(name)) bytes.copyWithin(results, state_at(k), state_at(k) + STATE * size);
        const found = bits.subarray(index(results), index(results) + count);
        compare(name, k, is_done, index(records) + k * RECORD + place, found);
    }
    place += 1 + count;
}

// so are the results by robot.mjs, for an ordinary state; it has an instance of its own
{
    const own = new Robot(await WebAssembly.instantiate(module, {}), Numbers);
    const input = (name, count) => numbers.subarray(index(at(0, name)), index(at(0, name)) + count);
    for (const name of ["torques", "desired_angles", "desired_rates"]) own[name].set(input(name, JOINTS));
    own.captured.set(input("captured", captured));
    const steps = {
        forward_dynamics: () => [own.forward_dynamics(), own.accelerations],
        control_step: () => [own.control_step(GAINS[0], GAINS[1], STEP), own.numbers],
        exact_impact: () => [own.exact_impact(), [...own.numbers, ...own.target_twists, ...own.impulses]],
        merge: () => [own.merge() && own.forward_dynamics(), own.accelerations],
    };
    for (const [name, step] of Object.entries(steps)) {
        own.numbers.set(input("state", STATE));
        const [is_done, found] = step();
        compare(`robot.mjs, ${name}`, 0, is_done, index(records) + place_of[name], new Bits(Numbers.from(found).buffer));
    }
}

const times = {};
function time(name, calls, run) {
    let least = Infinity;
    for (let attempt = 0; attempt < RUNS; attempt++) {
        restore();
        const start = performance.now();
        run();
        least = Math.min(least, performance.now() - start);
    }
    times[name] = Math.round((least * 1e6) / calls);
}
for (const name of ["forward_dynamics", "control_step", "exact_impact"]) {
    const one = call[name];
    time(name, ORDINARY, () => {
        for (let k = 0; k < ORDINARY; k++) one(k);
    });
}

// as many states as there are lanes at once: the bits of each alone
if (lanes) {
    const interleave = (from, to, count) => {
        for (let i = 0; i < count; i++)
            for (let lane = 0; lane < lanes; lane++) numbers[index(to) + i * lanes + lane] = numbers[index(from(lane)) + i];
    };
    interleave(() => parameters, in_lanes.parameters, PARAMETERS);
    functions.new_robots(in_lanes.parameters, in_lanes.robots);
    const groups = ORDINARY / lanes;
    const states_of = (group) => in_lanes.states + group * lanes * STATE * size;
    const torques_of = (group) => in_lanes.torques + group * lanes * JOINTS * size;
    const run = (group) =>
        functions.forward_dynamics_of_lanes(in_lanes.robots, states_of(group), torques_of(group), in_lanes.accelerations);
    for (let group = 0; group < groups; group++) {
        interleave((lane) => at(group * lanes + lane, "state"), states_of(group), STATE);
        interleave((lane) => at(group * lanes + lane, "torques"), torques_of(group), JOINTS);
        const is_done = run(group);
        for (let lane = 0; lane < lanes; lane++) {
            const k = group * lanes + lane;
            const found = Bits.from({ length: SIZE }, (_, i) => bits[index(in_lanes.accelerations) + i * lanes + lane]);
            const right = index(records) + k * RECORD + place_of.forward_dynamics;
            compare(`forward_dynamics_of_lanes, lane ${lane}`, k, is_done, right, found);
        }
    }
    time("forward_dynamics_of_lanes", ORDINARY, () => {
        for (let group = 0; group < groups; group++) run(group);
    });
}
console.log(JSON.stringify({ compared, times }));
