// A robot in a WebAssembly module, for Node.js and browsers: memory for its numbers, and its functions.
//
//     const { instance } = await WebAssembly.instantiate(bytes, {});
//     const robot = new Robot(instance, Float64Array);
//     robot.state.joint_angles.set([0.7, -1.6, 1.0, 2.4, 1.6, -1.0]);
//     robot.control_step(49, 14, 0.001);

export const ARMS = 2;
export const JOINTS = 6;
export const SIZE = 3 + JOINTS;
export const PARAMETERS = 30;
const CAPTURED = 7;
const STATE = 2 * SIZE;

/** Linear memory above the stack and the constants of a module, handed out once and never freed. */
export class Memory {
    constructor(instance) {
        this.memory = instance.exports.memory;
        this.next = instance.exports.__heap_base.value;
    }

    /** The address of so many bytes. A page that is added makes the views of before useless: take all memory first. */
    bytes(count) {
        const address = Math.ceil(this.next / 16) * 16;
        this.next = address + count;
        const missing = this.next - this.memory.buffer.byteLength;
        if (missing > 0) this.memory.grow(Math.ceil(missing / 65536));
        return address;
    }
}

/** A robot with one state. Numbers is Float64Array, or Float32Array for a module built with the feature `single`. */
export class Robot {
    constructor(instance, Numbers) {
        const functions = instance.exports;
        const memory = new Memory(instance);
        const size = Numbers.BYTES_PER_ELEMENT;
        const at = {
            robot: memory.bytes(functions.robot_bytes()),
            parameters: memory.bytes(PARAMETERS * size),
            state: memory.bytes(STATE * size),
            torques: memory.bytes(JOINTS * size),
            desired_angles: memory.bytes(JOINTS * size),
            desired_rates: memory.bytes(JOINTS * size),
            accelerations: memory.bytes(SIZE * size),
            captured: memory.bytes(ARMS * CAPTURED * size),
            target_twists: memory.bytes(ARMS * 3 * size),
            impulses: memory.bytes(ARMS * 3 * size),
        };
        const view = (address, count) => new Numbers(memory.memory.buffer, address, count);
        this.parameters = view(at.parameters, PARAMETERS);
        this.numbers = view(at.state, STATE);
        this.state = {
            base_pose: this.numbers.subarray(0, 3),
            joint_angles: this.numbers.subarray(3, SIZE),
            base_twist: this.numbers.subarray(SIZE, SIZE + 3),
            joint_rates: this.numbers.subarray(SIZE + 3),
        };
        this.torques = view(at.torques, JOINTS);
        this.desired_angles = view(at.desired_angles, JOINTS);
        this.desired_rates = view(at.desired_rates, JOINTS);
        this.accelerations = view(at.accelerations, SIZE);
        /** Per arm: mass, inertia, contact [rx, ry], twist [ω, vx, vy]; mass 0 where it captures nothing. */
        this.captured = view(at.captured, ARMS * CAPTURED);
        this.target_twists = view(at.target_twists, ARMS * 3);
        this.impulses = view(at.impulses, ARMS * 3);

        /** Makes the robot that of `parameters`; at first these are the layout's. */
        this.set_parameters = () => functions.new_robot(at.parameters, at.robot);
        functions.default_parameters(at.parameters);
        this.set_parameters();
        // each of them: whether there is a result
        /** `accelerations` of `state` under `torques`. */
        this.forward_dynamics = () => functions.forward_dynamics(at.robot, at.state, at.torques, at.accelerations) === 1;
        /** Advances `state` by a step (s) under PD control to `desired_angles` and `desired_rates`. */
        this.control_step = (proportional_gain, derivative_gain, step) =>
            functions.control_step(
                at.robot, at.state, at.desired_angles, at.desired_rates, proportional_gain, derivative_gain, step,
            ) === 1;
        /** Captures `captured`: `state`, `target_twists`, `impulses`. */
        this.exact_impact = () =>
            functions.exact_impact(at.robot, at.state, at.captured, at.target_twists, at.impulses) === 1;
        /** Makes it the robot that holds `captured`. */
        this.merge = () => functions.merge(at.robot, at.state, at.captured) === 1;
    }
}
