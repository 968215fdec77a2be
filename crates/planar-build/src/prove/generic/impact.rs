//! Rigid capture, eqs. (10) to (16): impulses and velocities after the impact from explicit contact matrices G and H.

use super::{Generic, GenericState, factor, length, store_matrix, store_split};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use planar_dynamics::dynamics::{Impact, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;
use planar_dynamics::target::Target;
use planar_dynamics::validate::{finite_target, store};

/// A target seen from the contact point.
struct Contact {
    arm: usize,
    /// N = `J_t⁻ᵀ I_t J_t⁻¹`.
    inertia: Matrix3<f64>,
    /// `J_t⁻ᵀ I_t t_ti`.
    momentum: Vector3<f64>,
}

impl Contact {
    /// `J_t` takes the twist of the target's COM to that of the contact point at r from it: v + ω × r, so that its
    /// inverse has −r.
    fn new(arm: usize, target: &Target<f64>) -> Result<Self, Error> {
        finite_target(target)?;
        let [rx, ry] = target.contact;
        let inverse = Matrix3::new(1.0, 0.0, 0.0, ry, 1.0, 0.0, -rx, 0.0, 1.0);
        let inertia = Matrix3::from_diagonal(&Vector3::new(target.inertia, target.mass, target.mass));
        Ok(Self {
            arm,
            inertia: inverse.transpose() * inertia * inverse,
            momentum: inverse.transpose() * inertia * Vector3::from(target.twist),
        })
    }
}

impl Generic {
    fn contacts(&self, targets: &[Option<Target<f64>>]) -> Result<Vec<Contact>, Error> {
        length("targets", self.arms(), targets.len())?;
        let given = targets.iter().enumerate().filter_map(|(arm, target)| Some((arm, target.as_ref()?)));
        given.map(|(arm, target)| Contact::new(arm, target)).collect()
    }

    /// (A + Σ Jᵀ N J, b + Σ `Jᵀ J_t⁻ᵀ I_t t_ti`), J the three rows of an arm with a target.
    fn with_contacts(
        contacts: &[Contact],
        jacobian: &DMatrix<f64>,
        mut inertia: DMatrix<f64>,
        mut momentum: DVector<f64>,
    ) -> (DMatrix<f64>, DVector<f64>) {
        for contact in contacts {
            let rows = jacobian.rows(3 * contact.arm, 3);
            inertia += rows.transpose() * contact.inertia * rows;
            momentum += rows.transpose() * contact.momentum;
        }
        (inertia, momentum)
    }
}

impl Impact<f64> for Generic {
    /// Eqs. (15) and (16): G = I + Σ Jᵀ N J and H = I θ̇ + Σ `Jᵀ J_t⁻ᵀ I_t t_ti` with the generalized I and J, and G `θ̇_f` = H.
    fn reduced_impact(
        &self,
        state: &State<'_, f64>,
        targets: &[Option<Target<f64>>],
        impact_matrix: &mut [f64],
        impact_momentum: &mut [f64],
        joint_rates_after: &mut [f64],
    ) -> Result<(), Error> {
        let now = GenericState::new(self, state)?;
        let contacts = self.contacts(targets)?;
        let reduced = self.reduced_at(&now.at)?;
        let momentum = &reduced.inertia * DVector::from_column_slice(state.joint_rates);
        let (matrix, momentum) = Self::with_contacts(&contacts, &reduced.jacobian, reduced.inertia, momentum);
        let rates = factor("the impact matrix G", &matrix)?.solve(&momentum);
        store_matrix("impact_matrix", &matrix, impact_matrix)?;
        store("impact_momentum", momentum.as_slice(), impact_momentum)?;
        store("joint_rates_after", rates.as_slice(), joint_rates_after)
    }

    /// The same in full coordinates: (M + Σ `J_eᵀ N J_e`) `v_f` = M `v_i` + Σ `J_eᵀ J_t⁻ᵀ I_t t_ti`.
    fn full_impact(
        &self,
        state: &State<'_, f64>,
        targets: &[Option<Target<f64>>],
        joint_rates_after: &mut [f64],
    ) -> Result<[f64; 3], Error> {
        let now = GenericState::new(self, state)?;
        let contacts = self.contacts(targets)?;
        let (mass_matrix, jacobian) = (now.at.mass_matrix(), now.at.end_effector_jacobian());
        let momentum = &mass_matrix * &now.velocity;
        let (matrix, momentum) = Self::with_contacts(&contacts, &jacobian, mass_matrix, momentum);
        let after = factor("the impact matrix G in full coordinates", &matrix)?.solve(&momentum);
        store_split(["base_twist_after", "joint_rates_after"], &after, joint_rates_after)
    }
}
