#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/sensor_calibration/ProfilometerFile.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using testing::HasSubstr;

struct Dialect {
    const char* name;
    std::string text;
    double ra_um, rz_um;
    std::size_t values = 1;
};

class ProfilometerDialect : public ::testing::TestWithParam<Dialect> {};

TEST_P(ProfilometerDialect, GivesRaAndRz) {
    const auto& dialect = GetParam();
    const auto found = test::accepted(parseProfilometer(dialect.text, "x.csv"));
    EXPECT_NEAR(found.ra_um, dialect.ra_um, 1e-9 * dialect.ra_um);
    EXPECT_EQ(found.raValues, dialect.values);
    if (std::isnan(dialect.rz_um)) {
        EXPECT_TRUE(std::isnan(found.rz_um));
    } else {
        EXPECT_NEAR(found.rz_um, dialect.rz_um, 1e-9 * dialect.rz_um);
    }
}

INSTANTIATE_TEST_SUITE_P(
    AsExported, ProfilometerDialect,
    ::testing::Values(
        Dialect{"semicolons", "Parameter;Wert;Einheit\r\nRq;1,9;µm\r\nRa;1,62;µm\r\nRz;11,3;µm\r\n", 1.62, 11.3},
        Dialect{"commas", "Instrument,SJ-410\nlc,0.8,mm\nRa,1.62,um\nRz,11.3,um\n", 1.62, 11.3},
        Dialect{"nanometres", "Ra [nm],9.5\nRz [nm],70\n", 0.0095, 0.07},
        Dialect{"mixed_units", "Ra (um)\t42\nRz (mm)\t0.29\n", 42, 290},
        Dialect{"latin_1", "Ra;1,62;\xB5m\nRz;11,3;\xB5m\n", 1.62, 11.3},
        Dialect{"byte_order_mark", "\xEF\xBB\xBFRa;1.62;\xCE\xBCm\n", 1.62, NAN},
        Dialect{"equals", "Ra = 1,62 µm\nRz = 11,3 µm\n", 1.62, 11.3},
        Dialect{"colon", "Ra: 1.62 um\nRz: 11,3 um\n", 1.62, 11.3},
        Dialect{"quoted", "\"Ra\",\"1,62\",\"um\"\n", 1.62, NAN},
        Dialect{"unit_first", "Ra;µm;1,62\nRz;µm;11,3\n", 1.62, 11.3},
        Dialect{"limits_behind", "Ra,1.62,um,0,3.2\nRz,11.3,um,0,20\n", 1.62, 11.3},
        Dialect{"table", "Trace,Ra (µm),Rz (µm)\n1,1.5,11\n2,1.7,12\n", 1.6, 11.5, 2},
        Dialect{"row_of_units", "Trace;Rz;Ra\n;µm;µm\n1;11;1,5\n2;12;1,7\n", 1.6, 11.5, 2},
        Dialect{"statistics", "No.;Ra [um];Rz [um]\n1;1,5;11\n2;1,7;12\nMean;1,6;11,5\nStd.;0,14;0,7\n", 1.6, 11.5, 1},
        Dialect{"others_between", "Ra max;9;um\nRamax;8;um\nRa;1.62;um\nRz1max;20;um\n", 1.62, NAN}),
    [](const auto& tested) { return std::string(tested.param.name); });

struct Refusal {
    const char* name;
    std::string text;
    const char* line;
    const char* reason;
};
class ProfilometerRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(ProfilometerRefusal, NamesTheLineAndTheReason) {
    RecordProperty("hazard", "H10");
    const auto found = parseProfilometer(GetParam().text, "x.csv");
    ASSERT_FALSE(found) << found->ra_um;
    EXPECT_EQ(found.error().code, ErrorCode::ParseError);
    EXPECT_THAT(found.error().message, HasSubstr("x.csv, line " + std::string(GetParam().line) + ":"));
    EXPECT_THAT(found.error().message, HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(Of, ProfilometerRefusal,
                         ::testing::Values(Refusal{"nothing", "x,y\n1,2\n", "3", "without Ra"},
                                           Refusal{"empty", "", "1", "without Ra"},
                                           Refusal{"no_unit", "lc;0.8;mm\nRa;1.62\n", "2", "without a unit"},
                                           Refusal{"another_unit", "Ra;1.62;in\n", "1", "without a unit"},
                                           Refusal{"no_value", "Rz;3;um\nRa;n/a;um\n", "2", "no value follows"},
                                           Refusal{"two_readings", "Ra,1,62,um\n", "1", "may be one number or two"},
                                           Refusal{"zero", "Ra;0;um\n", "1", "above 0"},
                                           Refusal{"negative", "Ra;-1;um\n", "1", "above 0"},
                                           Refusal{"not_a_number", "Ra;nan;um\n", "1", "no value follows"},
                                           Refusal{"rz_below_ra", "Ra;2;um\nRz;1;um\n", "2", "at least Ra"},
                                           Refusal{"utf_16", std::string("\xFF\xFER\0a\0", 6), "1", "UTF-16"}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(ProfilometerFile, IsReadFromDiskAndMissedByName) {
    test::ScratchDir folder;
    const auto path = folder.write("p120.csv", "Ra;42,4;µm\n");
    EXPECT_NEAR(readProfilometer(path).value().ra_um, 42.4, 1e-9);
    EXPECT_THAT(readProfilometer(folder.path() / "none.csv"), test::refused(ErrorCode::NotFound));
    const auto large = folder.write("profile.csv", std::string(kLargestProfilometerFile + 1, '1'));
    EXPECT_FALSE(readProfilometer(large));
}

}  // namespace
}  // namespace tacto
