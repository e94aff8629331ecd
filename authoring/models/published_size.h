// Published sizes of the structures of a knee, with their sources. A range of the library is the
// mean and two standard deviations to either side, which holds 95 % of a normal population; where a
// source gives a range itself, that range. m. resources/doc/models.md lists the same rows.
#pragma once

#include <span>

#include "simulation/core/options.h"
#include "simulation/core/units.h"

namespace arthro::authoring {

struct SizeSource {
  const char* author;
  int year;
  const char* title;
  const char* where;  // journal, doi or address
};

inline constexpr SizeSource kDhananjaya2014{
    "Dhananjaya et al.", 2014,
    "In vivo morphometry of menisci of the knee in South Indians: a preliminary study",
    "Biomedical Journal 37(1) 14, doi 10.4103/2319-4170.117889"};
inline constexpr SizeSource kGupta2015{
    "Gupta, Bhavsar, Ambiye", 2015,
    "Correlation of tibial meniscus with tibial plateau and its clinical significance",
    "International Journal of Anatomy and Research 3(2) 1073"};
inline constexpr SizeSource kMurlimanju2012{
    "Murlimanju et al.", 2012,
    "Clinically oriented morphometric study of medial and lateral menisci of the knee joint in "
    "adult cadavers",
    "La Clinica Terapeutica 163(2) 105"};
inline constexpr SizeSource kMurlimanjuTibia{
    "Murlimanju et al.", 2016,
    "Anatomical morphometry of the tibial plateau in South Indian population",
    "Italian Journal of Anatomy and Embryology, fupress.net/index.php/ijae/article/view/20275"};
inline constexpr SizeSource kKapur{"Kapur et al.", 2017,
                                   "Distal femoral morphology: the difference between genders",
                                   "Folia Medica Facultatis Medicinae Universitatis Saraeviensis, "
                                   "article 144"};
inline constexpr SizeSource kEckstein2001{
    "Eckstein et al.", 2001,
    "Range and variability of cartilage volume, thickness and surface areas in the knee",
    "Osteoarthritis and Cartilage 9(2) 101, PMID 11237657"};
inline constexpr SizeSource kIranpour2008{"Iranpour et al.", 2008,
                                          "Patellar dimensions of Caucasians",
                                          "as cited in table 10 of doi 10.1186/s42836-022-00117-8"};
inline constexpr SizeSource kSiebold2014{
    "Siebold et al.", 2014,
    "Flat midsubstance of the anterior cruciate ligament with tibial C-shaped insertion site",
    "Knee Surgery, Sports Traumatology, Arthroscopy 23(11) 3136, doi 10.1007/s00167-014-3058-6"};
inline constexpr SizeSource kDuthon2006{
    "Duthon et al.", 2006, "Anatomy of the anterior cruciate ligament",
    "as cited in simtk.org/docman/view.php/1061, section ACL anatomy"};
inline constexpr SizeSource kOtagoF069{"University of Otago Pathology Museum", 0,
                                       "Specimen F069, knee, loose bodies",
                                       "pathmuseum.otago.ac.nz"};
inline constexpr SizeSource kChosen{"chosen", 0, "no published value was found", ""};

struct PublishedSize {
  const char* quantity;
  double mean = 0, least = 0, most = 0;  // m
  const SizeSource* source = nullptr;

  constexpr Range InRange() const { return {least, most}; }
};

// Mean and standard deviation, mm.
constexpr PublishedSize Spread(const char* quantity, double mean, double deviation,
                               const SizeSource& source) {
  return {quantity, MetresFromMm(mean), MetresFromMm(mean - 2 * deviation),
          MetresFromMm(mean + 2 * deviation), &source};
}
// Typical value and limits, mm.
constexpr PublishedSize Between(const char* quantity, double typical, double least, double most,
                                const SizeSource& source) {
  return {quantity, MetresFromMm(typical), MetresFromMm(least), MetresFromMm(most), &source};
}

struct MeniscusSizes {
  PublishedSize length, width, horn_distance, outer_border, inner_border;
  PublishedSize anterior_width, body_width, posterior_width;
  PublishedSize anterior_height, body_height, posterior_height;
};
inline constexpr MeniscusSizes kMedialMeniscusSizes{
    Spread("length, front to back", 42.28, 3.71, kGupta2015),
    Spread("width, side to side", 31.67, 3.40, kGupta2015),
    Spread("distance between the horns", 24.13, 4.19, kMurlimanju2012),
    Spread("outer border", 99.06, 11.21, kMurlimanju2012),
    Spread("inner border", 55.44, 8.37, kMurlimanju2012),
    Spread("width of the anterior horn", 10.5, 1.2, kDhananjaya2014),
    Spread("width of the body", 7.8, 1.0, kDhananjaya2014),
    Spread("width of the posterior horn", 13.9, 0.9, kDhananjaya2014),
    Spread("thickness of the anterior horn", 6.3, 1.1, kDhananjaya2014),
    Spread("thickness of the body", 5.2, 1.3, kDhananjaya2014),
    Spread("thickness of the posterior horn", 6.9, 1.1, kDhananjaya2014)};
inline constexpr MeniscusSizes kLateralMeniscusSizes{
    Spread("length, front to back", 32.73, 3.08, kGupta2015),
    Spread("width, side to side", 33.22, 3.37, kGupta2015),
    Spread("distance between the horns", 11.31, 3.86, kMurlimanju2012),
    Spread("outer border", 90.25, 9.36, kMurlimanju2012),
    Spread("inner border", 50.63, 5.33, kMurlimanju2012),
    Spread("width of the anterior horn", 11.8, 1.4, kDhananjaya2014),
    Spread("width of the body", 8.6, 1.2, kDhananjaya2014),
    Spread("width of the posterior horn", 12.0, 0.9, kDhananjaya2014),
    Spread("thickness of the anterior horn", 4.8, 0.7, kDhananjaya2014),
    Spread("thickness of the body", 6.4, 1.1, kDhananjaya2014),
    Spread("thickness of the posterior horn", 7.0, 0.9, kDhananjaya2014)};

struct CartilageSizes {
  PublishedSize length, width, thickness;
};
inline constexpr CartilageSizes kMedialCondyleSizes{
    Spread("depth of the condyle, front to back", 61.88, 4.04, kKapur),
    Spread("width of the condyle", 26.73, 2.77, kKapur),
    Between("mean thickness", 2.0, 1.57, 2.43, kEckstein2001)};
inline constexpr CartilageSizes kLateralCondyleSizes{
    Spread("depth of the condyle, front to back", 64.67, 4.48, kKapur),
    Spread("width of the condyle", 28.11, 2.71, kKapur),
    Between("mean thickness", 2.0, 1.57, 2.43, kEckstein2001)};
inline constexpr CartilageSizes kMedialPlateauSizes{
    Spread("length, front to back", 39.8, 3.8, kMurlimanjuTibia),
    Spread("width, side to side", 26.7, 2.8, kMurlimanjuTibia),
    Between("mean thickness", 2.0, 1.57, 2.43, kEckstein2001)};
inline constexpr CartilageSizes kLateralPlateauSizes{
    Spread("length, front to back", 33.6, 3.7, kMurlimanjuTibia),
    Spread("width, side to side", 26.1, 2.9, kMurlimanjuTibia),
    Between("mean thickness", 2.2, 1.57, 2.43, kEckstein2001)};
// The largest value of the thickness is the source's largest one at a point.
inline constexpr CartilageSizes kPatellaSizes{
    Spread("height, top to bottom", 34.4, 3.8, kIranpour2008),
    Spread("width, side to side", 44.8, 4.8, kIranpour2008),
    Between("mean thickness", 2.76, 1.57, 5.72, kEckstein2001)};

inline constexpr PublishedSize kLooseBodyLength =
    Between("longest diameter", 9.0, 3.0, 50.0, kOtagoF069);
inline constexpr PublishedSize kTuftLength =
    Between("length of the villi", 5.0, 2.0, 12.0, kChosen);
// Mean of the source; it gives no deviation. The limits are 7 and 13 mm, the diameters that other
// authors report in doi 10.1007/s00167-014-3146-7, and half to twice the mean thickness.
inline constexpr PublishedSize kStumpWidth = Between("width", 9.9, 7.0, 13.0, kSiebold2014);
inline constexpr PublishedSize kStumpThickness = Between("thickness", 3.9, 2.0, 7.8, kSiebold2014);
// A stump is shorter than the whole ligament, 22 to 41 mm.
inline constexpr PublishedSize kStumpLength = Between("length", 12.0, 4.0, 22.0, kDuthon2006);

}  // namespace arthro::authoring
