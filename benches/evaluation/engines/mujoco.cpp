// Times of MuJoCo: the robot as two slides and hinges, without gravity and contacts.
#include "input.hpp"
#include <mujoco/mujoco.h>
#include <sstream>

// MJCF; `control` is the PD control of the joints as springs and dampers.
static std::string mjcf(const Input &input, bool control) {
    std::ostringstream text;
    text.precision(17);
    auto inertial = [&](double x, double y, double mass, double inertia) {
        // the other moments of inertia have no part in the plane
        text << "<inertial pos='" << x << " " << y << " 0' mass='" << mass << "' diaginertia='" << inertia << " "
             << inertia << " " << inertia << "'/>";
    };
    text << "<mujoco><compiler angle='radian'/><option gravity='0 0 0' timestep='" << input.step
         << "' integrator='RK4'><flag contact='disable' constraint='disable'/></option><worldbody><body>"
         << "<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/><joint type='hinge' axis='0 0 1'/>";
    inertial(0.0, 0.0, input.base_mass, input.base_inertia);
    for (const Arm &arm : input.arms) {
        double x = arm.mount[0], y = arm.mount[1], angle = arm.angle;
        for (const Link &link : arm.links) {
            text << "<body pos='" << x << " " << y << " 0' euler='0 0 " << angle << "'><joint type='hinge' axis='0 0 1'";
            if (control) text << " stiffness='" << input.gains[0] << "' damping='" << input.gains[1] << "'";
            text << "/>";
            inertial(link.com[0], link.com[1], link.mass, link.inertia);
            x = link.length;
            y = angle = 0.0;
        }
        for (std::size_t i = 0; i < arm.links.size(); ++i) text << "</body>";
    }
    text << "</body></worldbody></mujoco>";
    return text.str();
}

struct Simulation {
    mjModel *model;
    mjData *data;

    Simulation(const std::string &text) {
        mjVFS files;
        mj_defaultVFS(&files);
        mj_addBufferVFS(&files, "robot.xml", text.data(), static_cast<int>(text.size()));
        char error[1000] = "";
        model = mj_loadXML("robot.xml", &files, error, sizeof error);
        mj_deleteVFS(&files);
        if (!model) {
            std::fprintf(stderr, "%s\n", error);
            std::exit(2);
        }
        data = mj_makeData(model);
    }

    // Of MuJoCo's base positions [x, y, yaw] the place of [yaw, x, y].
    static int place(int i) { return i < 3 ? (i + 2) % 3 : i; }

    void set(const State &s) {
        for (int i = 0; i < 3; ++i) {
            data->qpos[place(i)] = s.base_pose[i];
            data->qvel[place(i)] = s.base_twist[i];
        }
        for (int i = 0; i < JOINTS; ++i) {
            data->qpos[3 + i] = s.joint_angles[i];
            data->qvel[3 + i] = s.joint_rates[i];
            data->qfrc_applied[3 + i] = s.torques[i];
        }
    }
};

int main(int, char **arguments) {
    const Input input = read(arguments[1]);
    Simulation free(mjcf(input, false)), controlled(mjcf(input, true));
    for (const State &s : input.states) {
        free.set(s);
        mj_forward(free.model, free.data);
        for (int i = 0; i < 3 + JOINTS; ++i) {
            agree("acceleration", free.data->qacc[Simulation::place(i)], s.accelerations[i], 1e-9);
        }
    }
    const double forward = each(input.states, [&](const State &s) {
        free.set(s);
        mj_forward(free.model, free.data);
        sink = free.data->qacc[3];
    });
    long count = 0;
    const double step = each(std::vector<int>(1), [&](int) {
        if (count++ % 20000 == 0) {
            mj_resetData(controlled.model, controlled.data);
            for (int i = 0; i < JOINTS; ++i) controlled.data->qpos[3 + i] = input.start[i];
        }
        mj_step(controlled.model, controlled.data);
        sink = controlled.data->qpos[0];
    });
    std::printf("{\"forward dynamics\": %.6g, \"step\": %.6g}\n", forward, step);
}
