// Times of Pinocchio: the robot as a planar joint and revolute ones, by its algorithms for one robot.
// Header only, so that it is compiled for this processor as all else.
#include "input.hpp"
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using pinocchio::Inertia;
using pinocchio::SE3;

struct Robot {
    pinocchio::Model model;
    std::vector<pinocchio::FrameIndex> end_effectors;
};

static Inertia body(double mass, double inertia, const double com[2]) {
    // the other moments of inertia have no part in the plane
    return Inertia(mass, Vector3d(com[0], com[1], 0.0), inertia * Matrix3d::Identity());
}

static SE3 place(double angle, double x, double y) {
    return SE3(Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(), Vector3d(x, y, 0.0));
}

static Robot robot(const Input &input) {
    Robot robot;
    auto &model = robot.model;
    model.gravity.setZero();
    const double origin[2] = {0.0, 0.0};
    const auto base = model.addJoint(0, pinocchio::JointModelPlanar(), SE3::Identity(), "base");
    model.appendBodyToJoint(base, body(input.base_mass, input.base_inertia, origin), SE3::Identity());
    for (std::size_t a = 0; a < input.arms.size(); ++a) {
        const Arm &arm = input.arms[a];
        auto parent = base;
        SE3 joint_place = place(arm.angle, arm.mount[0], arm.mount[1]);
        for (std::size_t k = 0; k < arm.links.size(); ++k) {
            const std::string name = std::to_string(a) + "." + std::to_string(k);
            const Link &link = arm.links[k];
            parent = model.addJoint(parent, pinocchio::JointModelRZ(), joint_place, name);
            model.appendBodyToJoint(parent, body(link.mass, link.inertia, link.com), SE3::Identity());
            joint_place = place(0.0, link.length, 0.0);
        }
        robot.end_effectors.push_back(model.addFrame(
            pinocchio::Frame("end" + std::to_string(a), parent, joint_place, pinocchio::OP_FRAME)));
    }
    return robot;
}

// Positions [x, y, cos, sin, angles] and velocities [vx, vy in base axes, rate, rates].
struct Motion {
    VectorXd q = VectorXd::Zero(4 + JOINTS), v = VectorXd::Zero(3 + JOINTS), tau = VectorXd::Zero(3 + JOINTS);
    double cosine = 1.0, sine = 0.0;

    template <typename Angles, typename Twist, typename Rates, typename Torques>
    void set(const double pose[3], const Angles &angles, const Twist &twist, const Rates &rates, const Torques &torques) {
        cosine = std::cos(pose[0]);
        sine = std::sin(pose[0]);
        q[0] = pose[1];
        q[1] = pose[2];
        q[2] = cosine;
        q[3] = sine;
        v[0] = cosine * twist[1] + sine * twist[2];
        v[1] = cosine * twist[2] - sine * twist[1];
        v[2] = twist[0];
        for (int i = 0; i < JOINTS; ++i) {
            q[4 + i] = angles[i];
            v[3 + i] = rates[i];
            tau[3 + i] = torques[i];
        }
    }

    // Accelerations of base [yaw, x, y] in inertial axes and of joints, of those in base axes.
    void inertial(const VectorXd &a, double out[3 + JOINTS]) const {
        const double x = a[0] - v[2] * v[1], y = a[1] + v[2] * v[0];
        out[0] = a[2];
        out[1] = cosine * x - sine * y;
        out[2] = sine * x + cosine * y;
        for (int i = 0; i < JOINTS; ++i) out[3 + i] = a[3 + i];
    }
};

// Generalized inertia, bias and Jacobian by elimination of the base.
struct Reduced {
    Eigen::Matrix<double, JOINTS, JOINTS> inertia;
    Eigen::Matrix<double, JOINTS, 1> bias;
    Eigen::Matrix<double, 3 * ARMS, JOINTS> jacobian;
    Eigen::Matrix<double, 6, 3 + JOINTS> frame;

    void compute(const Robot &robot, pinocchio::Data &data, const VectorXd &q, const VectorXd &v) {
        const auto &model = robot.model;
        pinocchio::crba(model, data, q);
        data.M.triangularView<Eigen::StrictlyLower>() = data.M.transpose().triangularView<Eigen::StrictlyLower>();
        const VectorXd &c = pinocchio::nonLinearEffects(model, data, q, v);
        pinocchio::computeJointJacobians(model, data, q);
        pinocchio::updateFramePlacements(model, data);
        const Eigen::LLT<Matrix3d> base(data.M.topLeftCorner<3, 3>());
        const Eigen::Matrix<double, 3, JOINTS> coupling = base.solve(data.M.topRightCorner<3, JOINTS>());
        inertia = data.M.bottomRightCorner<JOINTS, JOINTS>() - data.M.bottomLeftCorner<JOINTS, 3>() * coupling;
        bias = c.tail<JOINTS>() - coupling.transpose() * c.head<3>();
        for (int a = 0; a < ARMS; ++a) {
            frame.setZero();
            pinocchio::getFrameJacobian(model, data, robot.end_effectors[a], pinocchio::LOCAL_WORLD_ALIGNED, frame);
            const auto reduced = frame.rightCols<JOINTS>() - frame.leftCols<3>() * coupling;
            jacobian.row(3 * a) = reduced.row(5);
            jacobian.middleRows<2>(3 * a + 1) = reduced.topRows<2>();
        }
    }
};

int main(int, char **arguments) {
    const Input input = read(arguments[1]);
    const Robot robot = ::robot(input);
    const auto &model = robot.model;
    pinocchio::Data data(model);
    Motion motion;
    Reduced reduced;
    std::vector<Motion> motions;
    for (const State &s : input.states) {
        motion.set(s.base_pose.data(), s.joint_angles, s.base_twist, s.joint_rates, s.torques);
        motions.push_back(motion);
        double found[3 + JOINTS];
        motion.inertial(pinocchio::aba(model, data, motion.q, motion.v, motion.tau, pinocchio::Convention::LOCAL), found);
        for (int i = 0; i < 3 + JOINTS; ++i) agree("acceleration", found[i], s.accelerations[i], 1e-10);
        reduced.compute(robot, data, motion.q, motion.v);
        for (int i = 0; i < JOINTS; ++i) {
            agree("generalized bias", reduced.bias[i], s.generalized_bias[i], 1e-10);
            for (int k = 0; k < JOINTS; ++k) {
                agree("generalized inertia", reduced.inertia(i, k), s.generalized_inertia[JOINTS * i + k], 1e-10);
                agree("generalized Jacobian", reduced.jacobian(i, k), s.generalized_jacobian[JOINTS * i + k], 1e-10);
            }
        }
    }
    const double forward = each(motions, [&](const Motion &m) {
        sink = pinocchio::aba(model, data, m.q, m.v, m.tau, pinocchio::Convention::LOCAL)[3];
    });
    const double derivatives = each(motions, [&](const Motion &m) {
        pinocchio::computeABADerivatives(model, data, m.q, m.v, m.tau);
        sink = data.ddq_dq(3, 3);
    });
    const double dynamics = each(motions, [&](const Motion &m) {
        reduced.compute(robot, data, m.q, m.v);
        sink = reduced.jacobian(0, 0);
    });

    // a motion under PD control by Runge–Kutta steps, from the start again before it is at rest
    constexpr int SIZE = 2 * (3 + JOINTS);
    std::array<double, SIZE> start{}, x;
    for (int i = 0; i < JOINTS; ++i) start[3 + i] = input.start[i];
    auto rate = [&](const std::array<double, SIZE> &at, std::array<double, SIZE> &out) {
        double torques[JOINTS];
        for (int i = 0; i < JOINTS; ++i) torques[i] = -input.gains[0] * at[3 + i] - input.gains[1] * at[6 + JOINTS + i];
        motion.set(&at[0], &at[3], &at[3 + JOINTS], &at[6 + JOINTS], torques);
        for (int i = 0; i < 3 + JOINTS; ++i) out[i] = at[3 + JOINTS + i];
        motion.inertial(pinocchio::aba(model, data, motion.q, motion.v, motion.tau, pinocchio::Convention::LOCAL),
                        &out[3 + JOINTS]);
    };
    long count = 0;
    const double h = input.step;
    const double step = each(std::vector<int>(1), [&](int) {
        if (count++ % 20000 == 0) x = start;
        std::array<double, SIZE> k1, k2, k3, k4, at;
        rate(x, k1);
        for (int i = 0; i < SIZE; ++i) at[i] = x[i] + 0.5 * h * k1[i];
        rate(at, k2);
        for (int i = 0; i < SIZE; ++i) at[i] = x[i] + 0.5 * h * k2[i];
        rate(at, k3);
        for (int i = 0; i < SIZE; ++i) at[i] = x[i] + h * k3[i];
        rate(at, k4);
        for (int i = 0; i < SIZE; ++i) x[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        sink = x[0];
    });
    std::printf("{\"forward dynamics\": %.6g, \"derivatives\": %.6g, \"reduced dynamics\": %.6g, \"step\": %.6g}\n",
                forward, derivatives, dynamics, step);
}
