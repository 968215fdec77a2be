//! Operations on two numbers each, of which vectors are made where a processor has them: methods of
//! [`Scalar`](super::Scalar).

/// Those of the trait: number by number.
macro_rules! number_by_number {
    ($($method:ident $operator:tt)*) => {
        $(
            #[doc(hidden)]
            #[allow(clippy::inline_always, reason = "a call would pass both through memory")]
            #[inline(always)]
            #[must_use]
            fn $method([a, b]: [Self; 2], [c, d]: [Self; 2]) -> [Self; 2] {
                [a $operator c, b $operator d]
            }
        )*

        #[doc(hidden)]
        #[allow(clippy::inline_always, reason = "a call would pass both through memory")]
        #[inline(always)]
        #[must_use]
        fn neg_both([a, b]: [Self; 2]) -> [Self; 2] {
            [-a, -b]
        }

        #[doc(hidden)]
        #[allow(clippy::inline_always, reason = "a call would pass both through memory")]
        #[inline(always)]
        #[must_use]
        fn mul_add_both([a, b]: [Self; 2], [c, d]: [Self; 2], [e, f]: [Self; 2]) -> [Self; 2] {
            [a.mul_add(c, e), b.mul_add(d, f)]
        }
    };
}

/// Those of a float: where the processor has no vectors the trait's.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
macro_rules! at_once {
    ($float:ident) => {};
}

/// Those of a float: vectors for `f64`.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
macro_rules! at_once {
    (f32) => {};
    (f64) => {
        $crate::scalar::both::at_once!(add_both + sub_both - mul_both * div_both /);
    };
    ($($method:ident $operator:tt)*) => {
        $(
            #[inline(always)]
            fn $method(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
                (wide::f64x2::new(a) $operator wide::f64x2::new(b)).to_array()
            }
        )*

        #[inline(always)]
        fn neg_both(a: [f64; 2]) -> [f64; 2] {
            (-wide::f64x2::new(a)).to_array()
        }

        #[inline(always)]
        fn mul_add_both(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> [f64; 2] {
            let [a, b, c] = [a, b, c].map(wide::f64x2::new);
            (if cfg!(feature = "fused") { a.mul_add(b, c) } else { a * b + c }).to_array()
        }
    };
}

pub(super) use {at_once, number_by_number};
