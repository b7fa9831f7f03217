//! The published bi-4 stencils, and what follows from them.
//!
//! Rows 1, 2, 5, 6 and 7 of the matrix of a bi-4 step, over points 1 to 24, as the paper prints them, but for entries that are
//! misprinted or missing there: these follow from symmetry, from the rows' sums and from the paper's construction
//! (`docs/methods/lens.md`). All other rows among the first twelve are images of these under the symmetries of the grid.

use super::layout::Symmetry;

/// Weights of a bi-4 step over points 1 to 24.
pub(super) struct Stencil {
    /// What numerators are divided by: 1, 8 or 16 times the paper's `kappa`, which is `2^22`.
    pub(super) denominator: i64,
    /// Numerators by number, beginning at 1.
    pub(super) numerators: [i64; 24],
}

const KAPPA: i64 = 1 << 22;

/// The stencils of the points 1, 2, 5, 6 and 7.
pub(super) const STENCILS: [Stencil; 5] = [
    Stencil {
        denominator: KAPPA,
        numerators: [
            811_090, 712_980, 651_654, 712_980, 396_360, 192_300, 0, 126_420, 271_800, 126_420, 0, 192_300,
            11_070, 4_155, 0, 0, 0, -5_535, -8_310, -5_535, 0, 0, 0, 4_155,
        ],
    },
    Stencil {
        denominator: 8 * KAPPA,
        numerators: [
            5_711_612, 7_604_042, 5_711_612, 4_098_598, 2_547_228, 1_874_136, -1_392, 1_874_136, 2_547_228,
            793_616, 0, 793_616, -12_216, 53_155, 116, 0, 116, 53_155, -12_216, -41_055, 0, 0, 0, -41_055,
        ],
    },
    Stencil {
        denominator: KAPPA,
        numerators: [
            1_082_610, 655_140, 479_430, 655_140, 578_440, 242_700, 0, 45_300, 167_544, 45_300, 0, 242_700,
            24_030, 7_995, 0, 0, 0, -12_015, -15_990, -12_015, 0, 0, 0, 7_995,
        ],
    },
    Stencil {
        denominator: 16 * KAPPA,
        numerators: [
            13_746_012, 19_897_458, 7_303_932, 5_091_390, 6_720_204, 6_962_248, -17_712, 3_288_936,
            2_477_004, 297_120, 0, 1_342_272, 110_328, 334_671, -1_404, 0, 4_356, 975, -258_600, -127_179, 0,
            0, 0, -63_147,
        ],
    },
    Stencil {
        denominator: 8 * KAPPA,
        numerators: [
            3_746_052, 14_524_470, 3_746_052, 456_666, 1_288_740, 4_139_016, 351_344, 4_139_016, 1_288_740,
            -62_832, 0, -62_832, -130_440, 149_757, 14_412, 0, 14_412, 149_757, -130_440, -33_729, 0, 0, 0,
            -33_729,
        ],
    },
];

/// Which stencil makes each of the points 1 to 12, as an index into [`STENCILS`], and the symmetry it is turned by.
pub(super) const RECOVERY: [(usize, Symmetry); 12] = [
    (0, Symmetry::Identity),
    (1, Symmetry::Identity),
    (0, Symmetry::Rotation),
    (1, Symmetry::Rotation),
    (2, Symmetry::Identity),
    (3, Symmetry::Identity),
    (4, Symmetry::Identity),
    (3, Symmetry::MirrorX),
    (2, Symmetry::Rotation),
    (3, Symmetry::Rotation),
    (4, Symmetry::Rotation),
    (3, Symmetry::MirrorY),
];

/// A mask over the points 1 to 24 of a bi-4 net, with exact weights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LimitMask {
    /// What numerators are divided by.
    pub denominator: i128,
    /// Numerators by number, beginning at 1.
    pub numerators: [i128; 24],
}

/// Limit masks to second order, in the order of [`QuadraticExpansion`](super::QuadraticExpansion): left eigenvectors of a bi-4 step
/// for the eigenvalues 1, 1/4 twice and 1/16 three times, dual to `1`, `f1 = u^2 - v^2`, `f2 = 2 u v`, `f1^2`, `f1 f2` and `f2^2`.
pub const LIMIT_MASKS: [LimitMask; 6] = [
    LimitMask {
        denominator: 2_081_368_459_328_830_926_216,
        numerators: [
            358_108_842_453_277_221_305,
            357_733_899_677_687_262_720,
            358_108_842_453_277_221_305,
            357_733_899_677_687_262_720,
            162_507_362_489_428_664_203,
            81_195_989_692_720_579_200,
            -57_854_341_418_843_520,
            81_195_989_692_720_579_200,
            162_507_362_489_428_664_203,
            81_195_989_692_720_579_200,
            -57_854_341_418_843_520,
            81_195_989_692_720_579_200,
            -72_954_328_411_612_760,
            31_655_969_087_569_420,
            4_821_195_118_236_960,
            0,
            4_821_195_118_236_960,
            31_655_969_087_569_420,
            -72_954_328_411_612_760,
            31_655_969_087_569_420,
            4_821_195_118_236_960,
            0,
            4_821_195_118_236_960,
            31_655_969_087_569_420,
        ],
    },
    LimitMask {
        denominator: 9_949_908_536_804,
        numerators: [
            2_701_996_277_760,
            0,
            -2_701_996_277_760,
            0,
            1_858_115_715_072,
            951_436_247_040,
            0,
            -951_436_247_040,
            -1_858_115_715_072,
            -951_436_247_040,
            0,
            951_436_247_040,
            217_326_206_190,
            110_349_037_095,
            -337_186_800,
            0,
            337_186_800,
            -110_349_037_095,
            -217_326_206_190,
            -110_349_037_095,
            337_186_800,
            0,
            -337_186_800,
            110_349_037_095,
        ],
    },
    LimitMask {
        denominator: 131_365_789_733_386,
        numerators: [
            0,
            56_124_382_649_856,
            0,
            -56_124_382_649_856,
            0,
            16_858_313_966_080,
            -45_391_140_864,
            16_858_313_966_080,
            0,
            -16_858_313_966_080,
            45_391_140_864,
            -16_858_313_966_080,
            0,
            1_324_054_106_967,
            3_782_595_072,
            0,
            3_782_595_072,
            1_324_054_106_967,
            0,
            -1_324_054_106_967,
            -3_782_595_072,
            0,
            -3_782_595_072,
            -1_324_054_106_967,
        ],
    },
    LimitMask {
        denominator: 111_528_440_786_908_704,
        numerators: [
            -14_500_897_734_312_889,
            -14_562_889_214_900_736,
            -14_500_897_734_312_889,
            -14_562_889_214_900_736,
            7_583_688_900_629_109,
            3_781_150_286_978_432,
            -23_257_623_735_936,
            3_781_150_286_978_432,
            7_583_688_900_629_109,
            3_781_150_286_978_432,
            -23_257_623_735_936,
            3_781_150_286_978_432,
            6_949_419_563_221_434,
            3_493_879_632_259_749,
            1_938_135_311_328,
            0,
            1_938_135_311_328,
            3_493_879_632_259_749,
            6_949_419_563_221_434,
            3_493_879_632_259_749,
            1_938_135_311_328,
            0,
            1_938_135_311_328,
            3_493_879_632_259_749,
        ],
    },
    LimitMask {
        denominator: 1_599_452,
        numerators: [
            0, 0, 0, 0, 0, 458_752, 0, -458_752, 0, 458_752, 0, -458_752, 0, 57_909, -720, 0, 720, -57_909,
            0, 57_909, -720, 0, 720, -57_909,
        ],
    },
    LimitMask {
        denominator: 17_158_221_659_524_416,
        numerators: [
            -7_872_535_994_989_405,
            5_793_396_912_987_648,
            -7_872_535_994_989_405,
            5_793_396_912_987_648,
            -4_265_762_944_771_575,
            2_649_952_223_245_184,
            -27_391_273_437_312,
            2_649_952_223_245_184,
            -4_265_762_944_771_575,
            2_649_952_223_245_184,
            -27_391_273_437_312,
            2_649_952_223_245_184,
            -85_540_896_334_062,
            576_682_268_907_393,
            2_282_606_119_776,
            0,
            2_282_606_119_776,
            576_682_268_907_393,
            -85_540_896_334_062,
            576_682_268_907_393,
            2_282_606_119_776,
            0,
            2_282_606_119_776,
            576_682_268_907_393,
        ],
    },
];
