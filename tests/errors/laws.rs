//! Laws and the bodies that they cannot serve.

use particle_damper::{
    Bodies, Body, ContactLaw, HertzMindlin, HertzTsuji, LawError, Material, MaterialId, Materials,
    RestitutionImpulse,
};

use super::table::{NAN, Table};

/// Bodies that a law cannot serve.
fn law_rows<L: ContactLaw>(table: &mut Table, law: impl Fn(Materials) -> L)
where
    L::Coefficients: std::fmt::Debug,
{
    let sphere = |radius, mass, id| Body::sphere(radius, mass, MaterialId(id));
    let ask = |law: L, first, second| law.coefficients(&Bodies::new(first, second));
    let value = |error: &LawError| matches!(error, LawError::Value(_));
    let good = sphere(1e-3, 1e-5, 0);
    let unknown = |number| move |e: &LawError| *e == LawError::UnknownMaterial(MaterialId(number));
    let acrylic = || Materials::from(Material::acrylic());
    table.row(
        ask(law(acrylic()), sphere(1e-3, 1e-5, 7), good),
        unknown(7),
        &["7"],
    );
    table.row(
        ask(law(acrylic()), good, Body::wall(MaterialId(3))),
        unknown(3),
        &["3"],
    );

    type Spoil = fn(&mut Material);
    let spoilt: [(Spoil, &str); 4] = [
        (|m| m.interaction.restitution = 1.5, "restitution"),
        (|m| m.interaction.friction = -1.0, "friction coefficient"),
        (|m| m.interaction.friction = NAN, "friction coefficient"),
        (
            |m| m.interaction.rolling_friction = -1.0,
            "rolling friction",
        ),
    ];
    for (spoil, quantity) in spoilt {
        let mut material = Material::acrylic();
        spoil(&mut material);
        table.row(ask(law(material.into()), good, good), value, &[quantity]);
    }
}

/// Constants that the strict laws alone work with.
fn strict_rows<L: ContactLaw>(table: &mut Table, law: impl Fn(Materials) -> L) {
    let good = Body::sphere(1e-3, 1e-5, Materials::FIRST);
    let value = |error: &LawError| matches!(error, LawError::Value(_));
    type Spoil = fn(&mut Material);
    let spoilt: [(Spoil, &str); 4] = [
        (|m| m.youngs_modulus = 0.0, "Young's modulus"),
        (|m| m.poissons_ratio = 0.7, "Poisson's ratio"),
        (|m| m.poissons_ratio = NAN, "Poisson's ratio"),
        (|m| m.interaction.restitution = 0.0, "restitution"),
    ];
    for (spoil, quantity) in spoilt {
        let mut material = Material::acrylic();
        spoil(&mut material);
        let answer = law(material.into()).coefficients(&Bodies::new(good, good));
        table.row(answer, value, &[quantity]);
    }
}

#[test]
fn laws_refuse_bodies_that_they_cannot_serve() {
    let mut table = Table::default();
    law_rows(&mut table, HertzTsuji::new);
    law_rows(&mut table, HertzMindlin::new);
    law_rows(&mut table, RestitutionImpulse::new);
    strict_rows(&mut table, HertzTsuji::new);
    strict_rows(&mut table, HertzMindlin::new);
    table.end(26);
}
