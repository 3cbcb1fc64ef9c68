//! The names that the symbolic core prints, which knows numbers.

use super::Model;
use crate::symbolic::{Index, Names};
use crate::syntax::{Factor, Kind};

impl Names for Model {
    fn coordinate(&self, block: u32) -> (String, bool) {
        let block = &self.blocks[block as usize];
        let name = if block.is_spinor() { block.spinor() } else { block.name.to_string() };
        (name, block.array.is_some())
    }
    fn row_length(&self, block: u32) -> Option<Index> {
        self.blocks[block as usize].row_length().cloned()
    }
    fn component(&self, block: u32) -> Option<usize> {
        self.blocks[block as usize].axis.map(|axis| axis.number)
    }
    fn is_rotation(&self, block: u32) -> bool {
        self.blocks[block as usize].factor == Factor::Rotation
    }
    fn velocity(&self) -> &'static str {
        match self.kind {
            Kind::Degenerate => "d",
            Kind::Regular => "dot",
        }
    }
    fn parameter(&self, field: u32) -> &str {
        &self.parameters[field as usize].text
    }
    fn size(&self, size: u32) -> &str {
        &self.sizes[size as usize].text
    }
    fn function(&self, function: u32) -> String {
        self.functions[function as usize].name.to_string()
    }
    fn scalar_field(&self, field: u32) -> &str {
        &self.scalar_fields[field as usize].text
    }
    fn is_taken(&self, name: &str) -> bool {
        let parts =
            |text: &str| text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|part| part == name);
        self.blocks.iter().any(|block| block.name == name)
            || self.parameters.iter().any(|parameter| parts(&parameter.text))
            || self.sizes.iter().any(|size| parts(&size.text))
            || self.functions.iter().any(|function| function.name == name)
            || self.declared_scalar_fields.iter().any(|field| field.name == name)
    }
}
