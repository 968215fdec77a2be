"""Dynamics of exported and imported URDFs: planar-capture against Pinocchio and MuJoCo at random states.

Every shipped layout and those of tests/urdf are exported and loaded by Pinocchio and by MuJoCo, each with its own
parser. tests/urdf/clutter.urdf is imported, and the original is loaded by Pinocchio. Compared are accelerations under
torques and a base wrench, in the paper's coordinates (the twist of the base's centre of mass, inertial axes), and
positions of the end effectors. Of tests/urdf/spatial.urdf a subtree with joints that are held is imported; Pinocchio
locks the same joints.

    PYTHON=$(python3 -m codegen.environment --reference)
    PYTHONPATH=. $PYTHON tests/urdf_dynamics.py [planar-capture, or another command that runs it]

prints the largest differences and exits with 1 if one exceeds its bound.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pinocchio as pin

from codegen.layout import Layout, read

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
STATES = 25
SEED = 2017
# Of each acceleration, relative to its largest: two solvers' rounding times the condition of the mass matrix.
ACCELERATION = 1e-11
# m and rad: sums of link vectors.
TIP = 1e-13
# Of a file: the link that is taken as the base, and the positions at which joints are held.
PARTS = {
    "spatial": (
        "torso",
        {
            "neck": -0.4,
            "left_yaw": 0.3,
            "left_slide": 0.12,
            "left_roll": 0.0,
            "left_wrist_roll": 0.0,
            "right_yaw": 0.3,
            "right_slide": 0.05,
            "right_roll": np.pi,
            "right_wrist_roll": 0.0,
        },
    )
}


def draw(layout: Layout, random: np.random.Generator) -> dict:
    """A state as `eval` reads it."""
    joints = layout.joints
    return {
        "base_pose": [random.uniform(-6, 6), *random.uniform(-3, 3, 2)],
        "joint_angles": list(random.uniform(-4, 4, joints)),
        "base_twist": list(random.uniform(-1, 1, 3)),
        "joint_rates": list(random.uniform(-2, 2, joints)),
        "joint_torques": list(random.uniform(-5, 5, joints)),
        "base_wrench": list(random.uniform(-10, 10, 3)),
    }


class Product:
    """The command line."""

    def __init__(self, command: list[str]):
        self.command = command

    def run(self, *arguments: str, text: str = "") -> str:
        result = subprocess.run(
            [*self.command, *arguments], cwd=ROOT, input=text, capture_output=True, text=True, check=False
        )
        if result.returncode != 0:
            sys.exit(f"{' '.join(arguments)}: exit code {result.returncode}\n{result.stderr}")
        return result.stdout

    def evaluate(self, layout: Path, states: list[dict]) -> list[dict]:
        """By the generic implementation; a test of equivalence compares the generated code with it."""
        return json.loads(self.run("eval", str(layout), "-", "--dynamics", "generic", text=json.dumps(states)))


def rotation(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def coordinate(joint, angle: float) -> list[float]:
    """Configuration in Pinocchio, which represents a joint without limits by a point on the circle."""
    return [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]


class Pinocchio:
    """An exported URDF: the base has Pinocchio's planar joint, whose velocity is in axes of the body."""

    def __init__(self, urdf: str, layout: Layout):
        self.model = pin.buildModelFromXML(urdf)
        self.data = self.model.createData()
        names = [f"{arm.name}_joint{k + 1}" for arm in layout.arms for k in range(len(arm.links))]
        assert self.model.njoints == len(names) + 2 and all(self.model.existJointName(name) for name in names)
        self.base, *self.joints = [self.model.joints[self.model.getJointId(name)] for name in ("base_joint", *names)]
        assert self.base.shortname() == "JointModelPlanar"
        self.tips = [self.model.getFrameId(f"{arm.name}_tip") for arm in layout.arms]

    def accelerations(self, state: dict) -> tuple[np.ndarray, list[np.ndarray]]:
        model, data, base = self.model, self.data, self.base
        yaw, x, y = state["base_pose"]
        turn = rotation(yaw)
        omega, *velocity = state["base_twist"]
        moment, *force = state["base_wrench"]
        q, v, tau = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
        q[base.idx_q : base.idx_q + 4] = [x, y, np.cos(yaw), np.sin(yaw)]
        v[base.idx_v : base.idx_v + 3] = [*(turn.T @ velocity), omega]
        tau[base.idx_v : base.idx_v + 3] = [*(turn.T @ force), moment]
        rows = zip(self.joints, *(state[key] for key in ("joint_angles", "joint_rates", "joint_torques")), strict=True)
        for joint, angle, rate, torque in rows:
            q[joint.idx_q : joint.idx_q + joint.nq] = coordinate(joint, angle)
            v[joint.idx_v], tau[joint.idx_v] = rate, torque
        rates = pin.aba(model, data, q, v, tau)
        local = rates[base.idx_v : base.idx_v + 3]
        # d(R v)/dt = R (dv/dt + omega x v)
        spin = omega * np.array([-v[base.idx_v + 1], v[base.idx_v]])
        linear = turn @ (local[:2] + spin)
        pin.framesForwardKinematics(model, data, q)
        tips = [data.oMf[tip].translation[:2].copy() for tip in self.tips]
        return np.array([local[2], *linear, *(rates[joint.idx_v] for joint in self.joints)]), tips


class MuJoCo:
    """An exported URDF: the base has slides along inertial axes and a hinge; massless end effectors are merged."""

    def __init__(self, urdf: str, layout: Layout):
        self.model = mujoco.MjModel.from_xml_string(urdf)
        self.data = mujoco.MjData(self.model)
        names = [f"{arm.name}_joint{k + 1}" for arm in layout.arms for k in range(len(arm.links))]
        base = self.model.body("base").jntadr[0]
        slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
        assert list(self.model.jnt_type) == [slide, slide] + [hinge] * (1 + len(names))
        joints = [base + 2, base, base + 1, *(self.model.joint(name).id for name in names)]
        self.q, self.v = self.model.jnt_qposadr[joints], self.model.jnt_dofadr[joints]

    def accelerations(self, state: dict) -> np.ndarray:
        data = self.data
        data.qpos[self.q] = [*state["base_pose"], *state["joint_angles"]]
        data.qvel[self.v] = [*state["base_twist"], *state["joint_rates"]]
        data.qfrc_applied[self.v] = [*state["base_wrench"], *state["joint_torques"]]
        mujoco.mj_forward(self.model, data)
        return data.qacc[self.v]


class Original:
    """An original URDF in Pinocchio, on a base that moves in the plane of the import."""

    def __init__(self, urdf: str, header: str, held: dict[str, float]):
        def triple(name):
            return np.array(json.loads(re.search(rf"{name} (\[.*?\])", header).group(1)))

        self.normal, self.x = triple("normal"), triple("x axis")
        self.y = np.cross(self.normal, self.x)
        base = pin.JointModelComposite(3)
        for joint in (
            pin.JointModelPrismaticUnaligned(self.x),
            pin.JointModelPrismaticUnaligned(self.y),
            pin.JointModelRevoluteUnaligned(self.normal),
        ):
            base.addJoint(joint)
        model = pin.buildModelFromXML(urdf, base)
        configuration = pin.neutral(model)
        for name, position in held.items():
            joint = model.joints[model.getJointId(name)]
            configuration[joint.idx_q : joint.idx_q + joint.nq] = coordinate(joint, position)
        self.model = pin.buildReducedModel(model, [model.getJointId(name) for name in held], configuration)
        self.model.gravity = pin.Motion.Zero()
        self.data = self.model.createData()
        rows = re.findall(r"^#   arm `.*`, joint \d+ = (-?)`(.*)`(?: ([+-]) (\S+) rad)?; moves", header, re.MULTILINE)
        # layout angle = sign * URDF angle + offset
        self.signs = np.array([-1.0 if minus else 1.0 for minus, *_ in rows])
        self.offsets = np.array([float(side + size) if side else 0.0 for *_, side, size in rows])
        self.joints = [self.model.joints[self.model.getJointId(name)] for _, name, *_ in rows]
        lever = self.model.inertias[1].lever  # of the base's centre of mass, with all that is fixed to the base
        self.com = np.array([self.x @ lever, self.y @ lever])
        self.tips = [self.model.getFrameId(name) for name in re.findall(r"^#   arm `.*`, tip = `(.*)`$", header, re.M)]

    def accelerations(self, state: dict) -> tuple[np.ndarray, list[np.ndarray]]:
        model, data = self.model, self.data
        yaw, *position = state["base_pose"]
        omega, *velocity = state["base_twist"]
        moment, *force = state["base_wrench"]
        lever = rotation(yaw) @ self.com
        across = np.array([-lever[1], lever[0]])
        q, v, tau = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
        q[:3], v[:3] = [*(position - lever), yaw], [*(velocity - omega * across), omega]
        tau[:3] = [*force, moment + across @ force]
        angles = self.signs * (np.array(state["joint_angles"]) - self.offsets)
        rates, torques = self.signs * state["joint_rates"], self.signs * state["joint_torques"]
        for joint, angle, rate, torque in zip(self.joints, angles, rates, torques, strict=True):
            q[joint.idx_q : joint.idx_q + joint.nq] = coordinate(joint, angle)
            v[joint.idx_v], tau[joint.idx_v] = rate, torque
        found = pin.aba(model, data, q, v, tau)
        linear = found[:2] + found[2] * across - omega**2 * lever
        joints = self.signs * [found[joint.idx_v] for joint in self.joints]
        pin.framesForwardKinematics(model, data, q)
        places = [data.oMf[tip].translation for tip in self.tips]
        return np.array([found[2], *linear, *joints]), [np.array([self.x @ p, self.y @ p]) for p in places]


def below(urdf: str, link: str) -> str:
    """The file with this link as its root."""
    robot = ElementTree.fromstring(urdf)
    joints = {
        (joint.find("parent").get("link"), joint.find("child").get("link")): joint for joint in robot.iter("joint")
    }
    kept, new = set(), {link}
    while new:
        kept |= new
        new = {child for parent, child in joints if parent in kept} - kept
    for element in robot.findall("link"):
        if element.get("name") not in kept:
            robot.remove(element)
    for (parent, _), joint in joints.items():
        if parent not in kept:
            robot.remove(joint)
    return ElementTree.tostring(robot, encoding="unicode")


def relative(found: list[np.ndarray], results: list[dict]) -> float:
    """Largest difference, each entry relative to its own largest value, so that a heavy base counts equally."""
    wanted = np.array([result["base_acceleration"] + result["joint_accelerations"] for result in results])
    return float((np.abs(np.array(found) - wanted).max(axis=0) / np.abs(wanted).max(axis=0)).max())


def end_effector_error(result: dict, tips: list[np.ndarray]) -> float:
    wanted = [pose[1:] for pose in result["end_effector_poses"]]
    # an arm without a frame at its end has no tip to be compared: the last of clutter.urdf
    return max(float(np.abs(found - tip).max()) for found, tip in zip(tips, wanted, strict=False))


def exported(product: Product, path: Path, random: np.random.Generator) -> list[float]:
    """Largest errors: accelerations by Pinocchio and by MuJoCo, end effectors by Pinocchio."""
    layout = read(path)
    states = [draw(layout, random) for _ in range(STATES)]
    results = product.evaluate(path, states)
    urdf = product.run("export", str(path))
    pinocchio, simulated = Pinocchio(urdf, layout), MuJoCo(urdf, layout)
    found, tips = zip(*map(pinocchio.accelerations, states), strict=True)
    errors = [relative(found, results), relative(list(map(simulated.accelerations, states)), results)]
    return [*errors, max(map(end_effector_error, results, tips))]


def imported(product: Product, path: Path, random: np.random.Generator) -> list[float]:
    """Largest errors: accelerations and end effectors by Pinocchio with the original file."""
    root, held = PARTS.get(path.stem, (None, {}))
    part = ["--subtree", root] if root else []
    part += [f"--fix={name}={position!r}" for name, position in held.items()]
    urdf = path.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "layout.toml"
        product.run("import", str(path), *part, "--out", str(target))
        layout = read(target)
        original = Original(below(urdf, root) if root else urdf, target.read_text(encoding="utf-8"), held)
        states = [draw(layout, random) for _ in range(STATES)]
        results = product.evaluate(target, states)
    found, tips = zip(*map(original.accelerations, states), strict=True)
    return [relative(found, results), max(map(end_effector_error, results, tips))]


def main() -> int:
    product = Product(sys.argv[1:] or ["cargo", "run", "--quiet", "--locked", "--release", "--"])
    random = np.random.default_rng(SEED)
    layouts = sorted((ROOT / "codegen" / "layouts").glob("*.toml")) + sorted((HERE / "urdf").glob("*.toml"))
    good = True
    print(f"{STATES} random states each, largest errors\n")
    print(f"{'exported':<20} {'Pinocchio':>10} {'MuJoCo':>10} {'tips, m':>10}")
    for path in layouts:
        errors = exported(product, path, random)
        good &= max(errors[:2]) <= ACCELERATION and errors[2] <= TIP
        print(f"{path.stem:<20}" + "".join(f" {error:>10.1e}" for error in errors))
    print(f"\n{'imported':<20} {'Pinocchio':>10} {'tips, m':>10}")
    for path in sorted((HERE / "urdf").glob("*.urdf")):
        errors = imported(product, path, random)
        good &= errors[0] <= ACCELERATION and errors[1] <= TIP
        print(f"{path.stem:<20}" + "".join(f" {error:>10.1e}" for error in errors))
    if not good:
        print(f"\nerror: over a bound: {ACCELERATION:.0e} of the accelerations, {TIP:.0e} m", file=sys.stderr)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
