// Robot and states that the Rust program has written, with the results that it computes, and the clock.
#pragma once
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

struct Link {
    double length, mass, inertia, com[2];
};

struct Arm {
    double mount[2], angle;
    std::vector<Link> links;
};

// Pose and twist of the base are [yaw, x, y] and [rate, vx, vy] of its COM, in inertial axes.
constexpr int JOINTS = 6, ARMS = 2;

struct State {
    std::array<double, 3> base_pose;
    std::array<double, JOINTS> joint_angles;
    std::array<double, 3> base_twist;
    std::array<double, JOINTS> joint_rates, torques;
    // of the generated code
    std::array<double, 3 + JOINTS> accelerations;
    std::array<double, JOINTS * JOINTS> generalized_inertia;
    std::array<double, JOINTS> generalized_bias;
    std::array<double, 3 * ARMS * JOINTS> generalized_jacobian;
};

struct Input {
    double base_mass, base_inertia;
    std::vector<Arm> arms;
    std::vector<State> states;
    // PD control to angles 0, N m/rad and N m s/rad; the angles of the start; a step, s
    double gains[2], start[JOINTS], step;
};

inline Input read(const char *path) {
    std::ifstream file(path);
    auto number = [&]() {
        double value;
        if (!(file >> value)) {
            std::fprintf(stderr, "%s ends too early\n", path);
            std::exit(2);
        }
        return value;
    };
    auto fill = [&](auto &values) {
        for (double &value : values) value = number();
    };
    Input input;
    input.base_mass = number();
    input.base_inertia = number();
    input.arms.resize(static_cast<std::size_t>(number()));
    for (Arm &arm : input.arms) {
        fill(arm.mount);
        arm.angle = number();
        arm.links.resize(static_cast<std::size_t>(number()));
        for (Link &link : arm.links) {
            link.length = number();
            link.mass = number();
            link.inertia = number();
            fill(link.com);
        }
    }
    fill(input.gains);
    fill(input.start);
    input.step = number();
    input.states.resize(static_cast<std::size_t>(number()));
    for (State &state : input.states) {
        fill(state.base_pose);
        fill(state.joint_angles);
        fill(state.base_twist);
        fill(state.joint_rates);
        fill(state.torques);
        fill(state.accelerations);
        fill(state.generalized_inertia);
        fill(state.generalized_bias);
        fill(state.generalized_jacobian);
    }
    return input;
}

// Ends the program where a result is not that of the generated code.
inline void agree(const char *what, double found, double expected, double tolerance) {
    if (!(std::abs(found - expected) <= tolerance * (1.0 + std::abs(expected)))) {
        std::fprintf(stderr, "%s: %.17g, generated code has %.17g\n", what, found, expected);
        std::exit(1);
    }
}

// Seconds of this thread's processor time.
inline double seconds() {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Nanoseconds per call, over all elements again and again for at least 20 ms, as in measure.rs.
template <typename T, typename F> double each(const std::vector<T> &elements, F evaluate) {
    auto pass = [&]() {
        for (const T &element : elements) evaluate(element);
    };
    pass();
    for (long passes = 1;; passes *= 2) {
        const double start = seconds();
        for (long i = 0; i < passes; ++i) pass();
        const double time = seconds() - start;
        if (time >= 0.02) return time * 1e9 / (static_cast<double>(passes) * static_cast<double>(elements.size()));
    }
}

// What is written to it counts as used.
inline volatile double sink;
