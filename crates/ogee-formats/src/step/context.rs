//! What stands around a shape in a STEP file: header, product, units.

use std::io::{self, Write};

use super::emitter::Emitter;
use super::options::{Options, Schema, Unit};
use super::syntax::{Id, Real, Text};

/// The strings in which the application protocols differ.
struct Protocol {
    schema: &'static str,
    name: &'static str,
    year: u32,
    application: &'static str,
}

fn protocol(schema: Schema) -> Protocol {
    match schema {
        Schema::Ap214 => Protocol {
            schema: "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }",
            name: "automotive_design",
            year: 2000,
            application: "core data for automotive mechanical design processes",
        },
        Schema::Ap242 => Protocol {
            schema: "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }",
            name: "ap242_managed_model_based_3d_engineering",
            year: 2014,
            application: "managed model based 3d engineering",
        },
    }
}

/// Everything up to and with `DATA;`.
pub(super) fn header<W: Write>(file: &mut Emitter<'_, W>, options: &Options) -> io::Result<()> {
    let Options { file_name, timestamp, originating_system, schema, .. } = options;
    let preprocessor = concat!("ogee-formats ", env!("CARGO_PKG_VERSION"));
    file.line(format_args!("ISO-10303-21;"))?;
    file.line(format_args!("HEADER;"))?;
    file.line(format_args!("FILE_DESCRIPTION(('Catmull-Clark control mesh converted to NURBS'),'2;1');"))?;
    file.line(format_args!(
        "FILE_NAME({},{},(''),(''),{},{},'');",
        Text(file_name),
        Text(timestamp),
        Text(preprocessor),
        Text(originating_system),
    ))?;
    file.line(format_args!("FILE_SCHEMA(({}));", Text(protocol(*schema).schema)))?;
    file.line(format_args!("ENDSEC;"))?;
    file.line(format_args!("DATA;"))
}

/// Everything from `ENDSEC;`.
pub(super) fn footer<W: Write>(file: &mut Emitter<'_, W>) -> io::Result<()> {
    file.line(format_args!("ENDSEC;"))?;
    file.line(format_args!("END-ISO-10303-21;"))
}

/// The product; returns the number of its `PRODUCT_DEFINITION_SHAPE`.
pub(super) fn product<W: Write>(file: &mut Emitter<'_, W>, options: &Options) -> io::Result<Id> {
    let Protocol { name: protocol, year, application, .. } = protocol(options.schema);
    let name = Text(&options.name);
    let context = file.entity(format_args!("APPLICATION_CONTEXT('{application}')"))?;
    file.entity(format_args!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','{protocol}',{year},{context})"
    ))?;
    let mechanical = file.entity(format_args!("PRODUCT_CONTEXT('',{context},'mechanical')"))?;
    let product = file.entity(format_args!("PRODUCT({name},{name},'',({mechanical}))"))?;
    file.entity(format_args!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"))?;
    let formation = file.entity(format_args!("PRODUCT_DEFINITION_FORMATION('','',{product})"))?;
    let design =
        file.entity(format_args!("PRODUCT_DEFINITION_CONTEXT('part definition',{context},'design')"))?;
    let definition = file.entity(format_args!("PRODUCT_DEFINITION('design','',{formation},{design})"))?;
    file.entity(format_args!("PRODUCT_DEFINITION_SHAPE('','',{definition})"))
}

/// The units and the uncertainty; returns the number of the context for representations.
pub(super) fn units<W: Write>(file: &mut Emitter<'_, W>, unit: Unit) -> io::Result<Id> {
    let length = length_unit(file, unit)?;
    let angle = file.entity(format_args!("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))"))?;
    let solid_angle =
        file.entity(format_args!("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())"))?;
    let uncertainty = file.entity(format_args!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{length},'distance_accuracy_value','')",
        Real(unit.uncertainty())
    ))?;
    file.entity(format_args!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty})) \
         GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle})) REPRESENTATION_CONTEXT('','3D'))"
    ))
}

fn length_unit<W: Write>(file: &mut Emitter<'_, W>, unit: Unit) -> io::Result<Id> {
    let prefix = match unit {
        Unit::Millimetre | Unit::Inch => ".MILLI.",
        Unit::Centimetre => ".CENTI.",
        Unit::Metre => "$",
    };
    let metric = file.entity(format_args!("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT({prefix},.METRE.))"))?;
    if unit != Unit::Inch {
        return Ok(metric);
    }
    let dimensions = file.entity(format_args!("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)"))?;
    let size = Real(unit.in_millimetres());
    let measure = file.entity(format_args!("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({size}),{metric})"))?;
    file.entity(format_args!(
        "(CONVERSION_BASED_UNIT('INCH',{measure}) LENGTH_UNIT() NAMED_UNIT({dimensions}))"
    ))
}
