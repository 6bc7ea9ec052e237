//! # Embed it
//!
//! A simulator that moves a container of its own (a body, a node, a mode) drives a damper in it. At
//! the end of each of its steps it says where the container is and how it moves, and gets back what
//! the particles did to it:
//!
//! ```
//! use particle_damper::glam::DVec3;
//! use particle_damper::{Cuboid, Damper, Filling, Material, Motion, Particle, RestitutionImpulse};
//!
//! let cavity = Cuboid::new(DVec3::splat(0.03))?;
//! let grains = Filling::new(1).with(30, Particle::new(3e-3, 2e-4)?);
//! let mut damper = Damper::builder(cavity, RestitutionImpulse::new(Material::acrylic()))
//!     .particles(grains.fill(&cavity)?)
//!     .time_step(1e-4)
//!     .build()?;
//!
//! // The host: a body of 0.1 kg that flies freely, along any axis.
//! let interval = 1e-3;
//! let mut body = Motion::at(DVec3::ZERO, DVec3::new(0.3, 1.0, -0.2));
//! for _ in 0..100 {
//!     body.velocity += DVec3::NEG_Y * 9.81 * interval;
//!     body.position += body.velocity * interval;
//!     let reaction = damper.drive(body, interval)?; // here: ten steps of 0.1 ms
//!     body.velocity += reaction.impulse / 0.1;
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - **Use the impulse.** [`Reaction::impulse`](crate::Reaction::impulse) over the interval is exactly
//!   the momentum that the particles lost; impacts between two exchanges are in it. The force at the
//!   end of the interval is a sample of something that comes in spikes.
//! - **Sub-steps** are the damper's own affair: the interval is cut so that no step is longer than its
//!   [time step](crate::Builder::time_step). Between its ends the container follows the cubic that has
//!   both motions.
//! - **A clock**: hand in an interval, or the time at its end
//!   ([`drive_to`](crate::Damper::drive_to), from [`start_time`](crate::Builder::start_time) on). A
//!   difference of two times up to 1e7 s counts as the multiple of the time step that it was meant to be.
//! - **Where it starts**: `.mount(Driven::at(motion))`, else at the origin and at rest. Gravity is the
//!   damper's: the particles' weight comes back as part of the impulse.
//! - **Several cavities, or a structure with equations of its own**: a [`Mount`](crate::Mount) of your
//!   own is solved together with the particles, without any coupling interval; see `examples/beam.rs`.
//!
//! # A body that turns
//!
//! Its [`Motion`](crate::Motion) has an orientation and an angular velocity besides
//! ([`turned`](crate::Motion::turned), in the plane [`turned_in_plane`](crate::Motion::turned_in_plane)), and
//! the reaction has an [angular impulse](crate::Reaction::angular_impulse), about where the container's origin
//! is at the end of the interval. A body turns about its centre of mass: that is where the angular impulse has
//! to be moved to. Here a box flies freely in the plane, whose container has its origin at a corner:
//!
//! ```
//! use particle_damper::glam::{DVec3, dvec3};
//! use particle_damper::{Damper, Driven, Filling, Material, Motion, Particle, RestitutionImpulse, Slot};
//!
//! let cavity = Slot::new(0.04, 0.03)?;
//! let (mass, inertia) = (0.1, 2e-5); // kg, kg m^2
//! let to_corner = dvec3(-0.02, -0.015, 0.0);
//! let corner = |body: Motion| {
//!     let corner = body.to_fixed(to_corner);
//!     Motion::at(corner, body.velocity_at(corner)).turned(body.orientation, body.angular_velocity)
//! };
//! let (mut place, mut velocity, mut angle, mut rate) = (DVec3::ZERO, DVec3::Y, 0.0, 5.0);
//! let mut body = Motion::at(place, velocity).turned_in_plane(angle, rate);
//!
//! let grains = Filling::new(1).with(20, Particle::new(3e-3, 2e-4)?);
//! let mut damper = Damper::builder(cavity, RestitutionImpulse::new(Material::acrylic()))
//!     .mount(Driven::at(corner(body)))
//!     .particles(grains.fill(&cavity)?)
//!     .time_step(1e-4)
//!     .build()?;
//! let interval = 1e-3;
//! for _ in 0..200 {
//!     velocity += DVec3::NEG_Y * 9.81 * interval;
//!     place += velocity * interval;
//!     angle += rate * interval;
//!     body = Motion::at(place, velocity).turned_in_plane(angle, rate);
//!     let reaction = damper.drive(corner(body), interval)?;
//!     let arm = corner(body).position - place;
//!     velocity += reaction.impulse / mass;
//!     rate += (reaction.angular_impulse + arm.cross(reaction.impulse)).z / inertia;
//! }
//! assert!(rate.abs() < 5.0); // grains take part of the spin over
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - Particles are given in the container's frame, wherever it stands; their velocities, and all forces,
//!   torques and reactions, are in the fixed frame. [`Filling::down`](crate::Filling::down) is a direction of
//!   the container: `orientation.inverse() * gravity`.
//! - Over an interval the container turns steadily, but for what both ends leave open: many revolutions pass,
//!   as long as the angular velocities at the ends tell of them. A step in which a wall would sweep over
//!   particles is an error.
//! - What was said of masses below holds for moments of inertia as well.
//! - A [`Mount`](crate::Mount) of your own turns containers by its coordinates, and feels
//!   [torques](crate::Load). [`RigidBody`](crate::RigidBody) is the free body in space or in the plane, solved
//!   together with the bed. `examples/rapier-host` hangs a box on a ball joint.
//!
//! # A host lighter than its bed
//! The loop above moves through an interval with the impulse of the one before. Particles of mass m that
//! ride along answer an acceleration with -m times it, so that a structure of mass M (whatever moves with
//! the container, in the direction in question) gets -m/M of its last acceleration back: **it diverges, at
//! any interval, unless m < M**, and it rings where m comes near M. A heavier bed needs a host that iterates
//! within the interval, as follows, or a [`Mount`](crate::Mount) that is solved together with the bed.
//!
//! # A step back
//! A host that iterates, or whose solver rejects steps, takes a snapshot before and restores it. The
//! impulse it supposes is corrected by a part of what it is off, 1 / (1 + m/M) at first, and then by what
//! the last two tries suggest (Aitken's relaxation; Kuettler & Wall 2008, doi 10.1007/s00466-008-0255-5).
//! Under a force law that converges up to m/M = 20 and beyond: its answer follows the motion without jumps.
//! An impulse law decides once a step which contacts rebound, and a bed that outweighs its host by far may
//! have no answer that fits. An interval in which no try was accepted is taken again in halves, and one that
//! cannot be is a failure.
//!
//! ```
//! # use particle_damper::glam::DVec3;
//! # use particle_damper::{Damper, Driven, Filling, HertzTsuji, Material, Motion, Particle, Slot};
//! # let grains = Filling::new(1).with(10, Particle::new(3e-3, 2e-4)?).fill(&Slot::paper())?;
//! # let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
//! #     .particles(grains)
//! #     .build()?;
//! let (mass, bed, stiffness) = (1e-4, 2e-3, 3.0);
//! let (mut x, mut v, mut impulse) = (0.0, 0.2, 0.0);
//! let mut interval = 1e-3_f64;
//! while damper.time() < 0.02 {
//!     let before = damper.snapshot();
//!     let (least, mut last) = (0.5 * mass / (mass + bed), None);
//!     let mut relaxation = 2.0 * least;
//!     let mut accepted = false;
//!     for _ in 0..20 {
//!         // The trapezoidal rule, solved for the end under the impulse supposed.
//!         let q = 0.25 * stiffness * interval * interval / mass;
//!         let end_v = (v * (1.0 - q) + (impulse - stiffness * x * interval) / mass) / (1.0 + q);
//!         let end_x = x + 0.5 * interval * (v + end_v);
//!         let end = Motion::at(DVec3::Y * end_x, DVec3::Y * end_v);
//!         let error = damper.drive(end, interval)?.impulse.y - impulse;
//!         accepted = error.abs() < 1e-6 * (mass + bed);
//!         if accepted {
//!             (x, v) = (end_x, end_v);
//!             break;
//!         }
//!         damper.restore(&before)?;
//!         if let Some(last) = last {
//!             let suggested: f64 = relaxation * last / (last - error);
//!             relaxation = suggested.clamp(least, 1.0);
//!         }
//!         last = Some(error);
//!         impulse += relaxation * error;
//!     }
//!     interval = if accepted { (2.0 * interval).min(1e-3) } else { 0.5 * interval };
//!     if interval < 1e-5 {
//!         return Err("host and bed do not agree".into());
//!     }
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `examples/ode-host` does so under a solver that chooses its own steps, `examples/rapier-host` needs
//! no way back. After an error ([`StepError`](crate::StepError)) a snapshot is the way on, too.
//!
//! A session that went wrong fits in one file: drive a [`Recorded`](crate::Recorded) damper, and write its
//! [`Recording`](crate::Recording). It is played again with the bits that it had, steps taken back included.
//!
//! # How long an interval
//! The host moves through an interval h with the impulse of the one before: the reaction is late. The
//! damper resolves impacts by itself, so what counts is how far the host's own motion comes in h.
//! Particles of mass m that ride along resist the acceleration of a structure of mass M; late by h,
//! that force takes energy away, and a vibration of angular frequency w seems to decay faster, by up to
//!
//! ```text
//! m w^2 h / (2 (M + m))   per second
//! ```
//! **Choose h so that this is small beside the decay that is to be measured.** There is nothing to gain
//! below the damper's own time step. A host that iterates, as above, is free of it.
//!
//! The paper's oscillator (period 166 ms) with 60 particles of its Table 1, let go at 20 mm; half of
//! the peak to peak in the last fifth of a second before t = 1 s and t = 2 s, mean of six beds, which differ
//! by 1 to 2 % among themselves:
//!
//! | h (ms) | at 1 s (mm) | at 2 s (mm) |
//! |---|---|---|
//! | solved together ([`SingleDof`](crate::SingleDof)) | 8.02 | 5.30 |
//! | 0.1 | 8.01 | 5.25 |
//! | 0.2 | 7.93 | 5.16 |
//! | 0.5 | 7.82 | 4.97 |
//! | 1 | 7.68 | 4.71 |
//! | 2 | 7.21 | 4.11 |
//! | 5 | 6.14 | 2.84 |
//! | 10 | 4.72 | 1.51 |
//! | 20 | 2.73 | 0.44 |
//!
//! At 20 ms, an eighth of a period, most of the damping that one sees is the coupling's. The table is made with
//! this program, in which the host is exact between exchanges, so that nothing but the coupling is at fault:
//!
//! ```
//! use particle_damper::glam::DVec3;
//! use particle_damper::{
//!     Damper, Driven, Filling, Material, Motion, Particle, RestitutionImpulse, SingleDof, Slot,
//! };
//!
//! type Failure = Box<dyn std::error::Error>;
//! const M: f64 = 0.086; // kg
//! const C: f64 = 0.08; // N s/m
//! const K: f64 = 123.4; // N/m
//!
//! fn bed(seed: u64) -> Result<Vec<Particle>, Failure> {
//!     let filling = Filling::new(seed).with(60, Particle::new(3e-3, 2e-4)?);
//!     Ok(filling.fill(&Slot::paper())?)
//! }
//!
//! fn half_peak_to_peak(record: &[f64]) -> f64 {
//!     let high = record.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
//!     0.5 * (high - record.iter().fold(f64::INFINITY, |a, b| a.min(*b)))
//! }
//!
//! fn together(seed: u64, until: f64) -> Result<f64, Failure> {
//!     let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
//!         .mount(SingleDof::paper().released_from(0.02, 0.0)?)
//!         .particles(bed(seed)?)
//!         .time_step(1e-4)
//!         .build()?;
//!     let mut record = Vec::new();
//!     while damper.time() < until {
//!         damper.step()?;
//!         if damper.time() > until - 0.2 {
//!             record.push(damper.coordinates()[0]);
//!         }
//!     }
//!     Ok(half_peak_to_peak(&record))
//! }
//!
//! fn hosted(h: f64, seed: u64, until: f64) -> Result<f64, Failure> {
//!     let at = |x: f64, v: f64| Motion::at(DVec3::Y * x, DVec3::Y * v);
//!     let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
//!         .mount(Driven::at(at(0.02, 0.0)))
//!         .particles(bed(seed)?)
//!         .time_step(1e-4)
//!         .build()?;
//!     let g = C / (2.0 * M);
//!     let w = (K / M - g * g).sqrt();
//!     let ((s, c), e) = ((w * h).sin_cos(), (-g * h).exp());
//!     let (mut x, mut v, mut force) = (0.02, 0.0, 0.0);
//!     let mut record = Vec::new();
//!     while damper.time() < until - 1e-9 {
//!         let r = x - force / K;
//!         x = force / K + e * (r * (c + g / w * s) + v * s / w);
//!         v = e * (v * (c - g / w * s) - r * K / M * s / w);
//!         force = damper.drive(at(x, v), h)?.impulse.y / h;
//!         if damper.time() > until - 0.2 {
//!             record.push(x);
//!         }
//!     }
//!     Ok(half_peak_to_peak(&record))
//! }
//!
//! let (mut exact, mut near, mut late) = (0.0, 0.0, 0.0);
//! for seed in 1..=6 {
//!     exact += together(seed, 1.0)?;
//!     near += hosted(2e-4, seed, 1.0)?;
//!     late += hosted(1e-2, seed, 1.0)?;
//! }
//! assert!((near / exact - 1.0).abs() < 0.02);
//! assert!(late / exact < 0.7);
//! # Ok::<(), Failure>(())
//! ```
