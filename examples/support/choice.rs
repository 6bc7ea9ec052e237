//! Detectors and integrators chosen at run time, each behind one type.

use clap::ValueEnum;
use particle_damper::integrator::System;
use particle_damper::{
    AllPairs, Bed, CellGrid, Detector, DetectorError, Integrator, LinkedCells, Neighbourhood,
    Pairs, RungeKutta4, Skin, StepError, VelocityVerlet,
};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DetectorName {
    /// Linked cells inside a skin, the fastest.
    LinkedCells,
    /// Every pair.
    AllPairs,
    /// The cellular-automaton grid with its exact neighbourhood.
    CellGrid,
    /// The cellular-automaton grid with the paper's 20 neighbours, which misses contacts.
    PaperGrid,
}

#[derive(Debug, Clone)]
pub(crate) enum AnyDetector {
    LinkedCells(Skin<LinkedCells>),
    AllPairs(AllPairs),
    CellGrid(CellGrid),
}

impl DetectorName {
    /// The detector; `grid` is the number of cells up and across.
    pub(crate) fn detector(self, grid: [usize; 2]) -> Result<AnyDetector, DetectorError> {
        let [up, across] = grid;
        Ok(match self {
            Self::LinkedCells => AnyDetector::LinkedCells(Skin::default()),
            Self::AllPairs => AnyDetector::AllPairs(AllPairs),
            Self::CellGrid => AnyDetector::CellGrid(CellGrid::new(across, up)?),
            Self::PaperGrid => {
                let grid = CellGrid::new(across, up)?;
                AnyDetector::CellGrid(grid.with_neighbourhood(Neighbourhood::Paper))
            }
        })
    }
}

impl Detector for AnyDetector {
    fn prepare(&mut self, bed: &Bed<'_>) -> Result<(), DetectorError> {
        match self {
            Self::LinkedCells(inner) => inner.prepare(bed),
            Self::AllPairs(inner) => inner.prepare(bed),
            Self::CellGrid(inner) => inner.prepare(bed),
        }
    }

    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        match self {
            Self::LinkedCells(inner) => inner.detect(bed, pairs),
            Self::AllPairs(inner) => inner.detect(bed, pairs),
            Self::CellGrid(inner) => inner.detect(bed, pairs),
        }
    }

    fn skin(&self, smallest_radius: f64) -> f64 {
        match self {
            Self::LinkedCells(inner) => inner.skin(smallest_radius),
            Self::AllPairs(inner) => inner.skin(smallest_radius),
            Self::CellGrid(inner) => inner.skin(smallest_radius),
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum IntegratorName {
    /// One evaluation a step.
    Verlet,
    /// The paper's, four evaluations a step.
    Rk4,
}

#[derive(Debug, Clone)]
pub(crate) enum AnyIntegrator {
    Verlet(VelocityVerlet),
    Rk4(Box<RungeKutta4>),
}

impl IntegratorName {
    pub(crate) fn integrator(self) -> AnyIntegrator {
        match self {
            Self::Verlet => AnyIntegrator::Verlet(VelocityVerlet),
            Self::Rk4 => AnyIntegrator::Rk4(Box::default()),
        }
    }
}

impl Integrator for AnyIntegrator {
    fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError> {
        match self {
            Self::Verlet(inner) => inner.step(system, time_step),
            Self::Rk4(inner) => inner.as_mut().step(system, time_step),
        }
    }
}
