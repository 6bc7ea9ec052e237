use std::fmt;

/// What a particle touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// Another particle, by number.
    Particle(usize),
    /// A wall of its cavity, by number.
    Wall(u32),
}

impl fmt::Display for Partner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Particle(number) => write!(f, "particle {number}"),
            Self::Wall(number) => write!(f, "wall {number}"),
        }
    }
}
