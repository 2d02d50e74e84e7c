// What a CIGI host asks of the scene: heights and lines of sight, once and with a period.
#include "live/cigi_questions.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "core/units.h"
#include "live/cigi_answers.h"
#include "terrain/geoid.h"
#include "tests/live/cigi_station.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using namespace fanbeam::tests;
using namespace feeds::cigi;

TEST_CASE("Heights are those of the ground, along the vertical of the place", "[cigi]") {
  Station station;
  station.hear(message(
      0x25, {entity(52.0, 10.0, 300.0), height_request(1, 52.0, 10.0, 120.0, 0),
             height_request(2, 52.0, 10.0, 120.0, 1), height_request(3, 52.001, 10.0001, 120.0, 2),
             height_request(4, 52.0, 11.0, 120.0, 2)}));
  const auto packets = packets_in(station.ig.begin_frame());
  REQUIRE(packets.size() == 5);
  CHECK(packets[1].first == 102);
  CHECK(packets[1].second.at<std::uint16_t>(2) == 1);
  CHECK(packets[1].second.byte(4) == 0x51);  // valid, height above, of frame ...5
  CHECK(packets[1].second.at<double>(8) == Approx(70.0).epsilon(0.0).margin(0.01));
  CHECK(packets[2].second.at<double>(8) == Approx(50.0).epsilon(0.0).margin(0.01));
  CHECK(packets[2].second.byte(4) == 0x53);
  REQUIRE(packets[3].first == 103);
  // 111.3 m along a runway that rises by 10 m in 1001, beside the paint of its centre line.
  CHECK(packets[3].second.at<double>(16) == Approx(51.11).epsilon(0.0).margin(0.05));
  CHECK(packets[3].second.at<double>(8) + packets[3].second.at<double>(16) == Approx(120.0));
  const auto& names = station.session->scene()->world.geometry->material_names;
  INFO(names.at(packets[3].second.at<std::uint32_t>(24)));
  CHECK(names.at(packets[3].second.at<std::uint32_t>(24)).find("asphalt") != std::string::npos);
  CHECK(packets[3].second.at<float>(32) == Approx(90.0).epsilon(0.0).margin(1.0));  // level
  CHECK(packets[4].second.bits(4, 0) == 0);                 // outside the terrain
  CHECK(packets_in(station.ig.begin_frame()).size() == 1);  // once
}

TEST_CASE("A question with a period is answered again and again", "[cigi]") {
  Station station;
  station.hear(message(1, {height_request(1, 52.0, 10.0, 120.0, 0, 3)}));
  int answers = 0;
  for (int frame = 0; frame < 12; ++frame)
    answers += static_cast<int>(packets_in(station.ig.begin_frame()).size()) - 1;
  CHECK(answers == 4);
  station.hear(message(2, {}, kStandby));
  station.hear(message(3, {}, kOperate));
  for (int frame = 0; frame < 6; ++frame) CHECK(packets_in(station.ig.begin_frame()).size() == 1);
}

TEST_CASE("A line of sight ends at what stands in it", "[cigi]") {
  const Station station;
  const auto scene = station.session->scene();
  // The hangar of the scene: 40 by 30 m and 12 m high, 300 m behind the threshold, 200 m to the left.
  const glm::dvec3 hangar_m =
      scene->frame.to_local_m({core::radians(52.0), core::radians(10.0), 50.0}) +
      glm::dvec3(-200.0, 300.0, 0.0);
  const auto place = [&](const glm::dvec3& at_m) {
    const core::Geodetic at = scene->frame.to_geodetic(at_m);
    return glm::dvec3(at.latitude_rad, at.longitude_rad, at.height_m);
  };
  SightRequest request;
  request.segment = request.extended = true;
  request.source = place(hangar_m + glm::dvec3(100.0, 0.0, 6.0));
  request.end = place(hangar_m + glm::dvec3(-100.0, 0.0, 6.0));
  const auto blocked = live::sight_answer(*scene, core::VerticalDatum::scene, request, {}, {});
  CHECK((blocked.valid && !blocked.visible));
  CHECK(blocked.range_m > 70.0);
  CHECK(blocked.range_m < 95.0);
  request.source.z += 30.0;
  request.end.z += 30.0;
  const auto over = live::sight_answer(*scene, core::VerticalDatum::scene, request, {}, {});
  CHECK((over.valid && over.visible));
  CHECK(over.range_m == Approx(200.0).epsilon(0.0).margin(0.1));

  SightRequest down;
  down.source = place({500.0, -500.0, 0.0});
  down.source.z = 250.0;
  down.elevation_rad = -core::kPi / 2;
  down.most_m = 1000.0;
  const auto ground = live::sight_answer(*scene, core::VerticalDatum::scene, down, {}, {});
  CHECK((ground.valid && !ground.visible));
  HeightRequest height;
  height.place = down.source;
  CHECK(ground.range_m ==
        Approx(live::height_answer(*scene, core::VerticalDatum::scene, height, {}).height_m)
            .epsilon(0.0)
            .margin(0.05));
  down.elevation_rad = core::kPi / 4;
  CHECK_FALSE(live::sight_answer(*scene, core::VerticalDatum::scene, down, {}, {}).valid);
  down.from_entity = true;  // of nobody
  CHECK_FALSE(live::sight_answer(*scene, core::VerticalDatum::scene, down, {}, {}).valid);
}

// It was taken for an offset from the entity that it begins at.
TEST_CASE("A line of sight to another entity ends there", "[cigi]") {
  enum : std::uint8_t { kExtended = 1, kFromEntity = 2, kToEntity = 4, kOwnEnd = 16 };
  Station station;
  const auto sight = [](std::uint8_t flags, double end_forward_m, std::uint16_t end_entity) {
    return Packet(25, 64, false)
        .put(4, flags)
        .put<std::uint16_t>(6, 0)
        .put(32, end_forward_m)
        .put(62, end_entity)
        .bytes();
  };
  constexpr std::uint8_t kBoth = kExtended | kFromEntity | kToEntity;
  // Both head east, two degrees down, the other one ahead.
  station.hear(message(1, {entity(52.0, 10.0, 300.0), entity(52.0, 10.01, 300.0, 90.0F, false, 7),
                           sight(kBoth | kOwnEnd, 0.0, 7), sight(kBoth | kOwnEnd, 50.0, 7),
                           sight(kBoth, 50.0, 7), sight(kBoth | kOwnEnd, 0.0, 9)}));
  const auto packets = packets_in(station.ig.begin_frame());
  REQUIRE(packets.size() == 5);
  const terrain::LocalFrame& frame = station.session->scene()->frame;
  const auto at_m = [&](double longitude_deg) {
    return frame.to_local_m({core::radians(52.0), core::radians(longitude_deg), 300.0});
  };
  const double apart_m = glm::length(at_m(10.01) - at_m(10.0));
  const auto range_m = [&](std::size_t i) { return packets[i].second.at<double>(8); };
  const auto flags = [&](std::size_t i) { return packets[i].bytes[4]; };
  constexpr std::uint8_t kValid = 1;
  CHECK((flags(1) & kValid) != 0);
  CHECK(range_m(1) == Approx(apart_m).epsilon(1e-6));
  CHECK((flags(2) & kValid) != 0);
  CHECK(range_m(2) > apart_m + 45.0);
  CHECK(range_m(2) < apart_m + 50.1);
  CHECK(range_m(3) == Approx(50.0).epsilon(1e-6));
  CHECK((flags(4) & kValid) == 0);  // of nobody
}

TEST_CASE("F15 questions beyond a datagram wait, beyond a thousand they are counted", "[cigi]") {
  Station station;
  std::vector<Bytes> questions;
  for (std::uint16_t i = 0; i < 1500; ++i)
    questions.push_back(height_request(i, 52.0, 10.0, 120.0, 0));
  station.hear(message(1, questions));
  int answers = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const Bytes told = station.ig.begin_frame();
    CHECK(told.size() <= 1472);
    answers += static_cast<int>(packets_in(told).size()) - 1;
  }
  CHECK(answers == 1024);
  CHECK(all_of(station.told().unused_packets) == 1500 - 1024);
}

// Those of low numbers were answered in every frame, most others never again.
TEST_CASE(
    "F15 questions with a period beyond a datagram are answered by turns and single ones at once",
    "[cigi]") {
  Station station;
  std::vector<Bytes> questions;
  constexpr std::uint16_t kPeriodic = 300;
  for (std::uint16_t i = 0; i < kPeriodic; ++i)
    questions.push_back(height_request(i, 52.0, 10.0, 120.0, 0, 1));
  station.hear(message(1, questions));
  std::array<int, kPeriodic> answers{};
  int in_all = 0;
  const auto answer_frame = [&](std::uint32_t host_frame) {
    bool single = false;
    const Bytes told = station.ig.begin_frame();
    CHECK(told.size() <= 1472);
    const auto packets = packets_in(told);
    for (std::size_t i = 1; i < packets.size(); ++i) {
      const auto number = packets[i].second.at<std::uint16_t>(2);
      // Of the frame in which it is given, not of that in which it came to wait.
      CHECK(packets[i].second.bits(4, 4, 4) == host_frame);
      if (number < kPeriodic) {
        ++answers.at(number);
        ++in_all;
      } else {
        single = true;
      }
    }
    return single;
  };
  for (std::uint32_t frame = 1; frame < 40; ++frame) {
    const std::uint32_t host_frame = frame < 20 ? 1 : 2;
    // One that is asked once beside them is in the next frame.
    if (frame == 20) station.hear(message(2, {height_request(kPeriodic, 52.0, 10.0, 120.0, 0)}));
    CHECK(answer_frame(host_frame) == (frame == 20));
  }
  const auto [fewest, most] = std::minmax_element(answers.begin(), answers.end());
  CHECK(*fewest >= 10);
  CHECK(*most <= *fewest + 1);
  // Each period was answered, or left out, or its question still waits.
  const auto unused = station.told().unused_packets;
  REQUIRE(unused.size() == 1);
  CHECK(unused[0].first == "periods of questions that still waited");
  const std::uint64_t told = unused[0].second + static_cast<std::uint64_t>(in_all),
                      periods = std::uint64_t{39} * kPeriodic;
  CHECK(told <= periods);
  CHECK(told + kPeriodic >= periods);
}

TEST_CASE("F15 many single questions keep out none with a period", "[cigi]") {
  Station station;
  constexpr std::uint16_t kSingle = 500;
  std::vector<Bytes> questions;
  for (std::uint16_t i = 0; i < kSingle; ++i)
    questions.push_back(height_request(i, 52.0, 10.0, 120.0, 0));
  questions.push_back(height_request(kSingle, 52.0, 10.0, 120.0, 0, 1));
  station.hear(message(1, questions));
  const auto periodic_answers = [&] {
    const auto packets = packets_in(station.ig.begin_frame());
    CHECK(packets.size() > 1);
    return std::count_if(packets.begin() + 1, packets.end(), [](const Told& told) {
      return told.second.at<std::uint16_t>(2) == kSingle;
    });
  };
  for (int frame = 0; frame < 5; ++frame) CHECK(periodic_answers() == 1);
  CHECK(station.told().unused_packets.empty());
}

// Asked once while it waits, it has no period any more.
TEST_CASE("A question that is asked anew takes the place of the one that waits", "[cigi]") {
  live::CigiQuestions questions;
  HeightRequest request;
  request.update_period = 1;
  questions.ask(request, 1);
  questions.begin_frame(1);
  request.place.x = 0.5;
  questions.ask(request, 2);
  auto asked = questions.next(3);
  REQUIRE(asked);
  CHECK(asked->host_frame == 3);
  CHECK(std::get<HeightRequest>(asked->question).place.x == 0.5);
  CHECK_FALSE(questions.next(3));
  questions.begin_frame(2);
  request.update_period = 0;
  questions.ask(request, 4);
  asked = questions.next(5);
  REQUIRE(asked);
  CHECK(asked->host_frame == 4);
  CHECK_FALSE(questions.next(5));
  questions.begin_frame(3);
  CHECK_FALSE(questions.next(5));
}

TEST_CASE("Heights over Innsbruck are those of its elevation model within a centimetre", "[cigi]") {
  const auto data = tests::shared_data("lowi-innsbruck");
  if (!data) return;
  core::ProblemList problems;
  const std::filesystem::path root(FANBEAM_SOURCE_DIR);
  session::Session session(root / "scenes/innsbruck-26",
                           session::Setup{.shipped = root, .data_folders = {data->parent_path()}},
                           problems);
  const auto scene = session.scene();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across_m(-6000.0, 6000.0);
  double worst_m = 0.0;
  for (int i = 0; i < 300; ++i) {
    const core::Geodetic at = scene->frame.to_geodetic({across_m(random), across_m(random), 0.0});
    HeightRequest request;
    request.kind = HeightKind::extended;
    request.place = {at.latitude_rad, at.longitude_rad, 3000.0};
    const auto answer = live::height_answer(*scene, core::VerticalDatum::egm96, request, {});
    if (!answer.valid) continue;
    // The same place at the answer's height lies on the ground.
    core::Geodetic foot{at.latitude_rad, at.longitude_rad, answer.ground_m};
    foot.height_m = terrain::ellipsoidal_height_m(foot, core::VerticalDatum::egm96);
    const glm::dvec3 foot_m = scene->frame.to_local_m(foot);
    const auto ground_m = scene->world.surfaces().terrain()->height_at(foot_m.x, foot_m.y);
    REQUIRE(ground_m.has_value());
    worst_m = std::max(worst_m, std::abs(foot_m.z - *ground_m));
    CHECK(answer.height_m + answer.ground_m == Approx(3000.0).epsilon(0.0).margin(1e-6));
    CHECK(answer.material ==
          scene->world.surfaces().material(terrain::kTerrainGeometry, 0, foot_m.x, foot_m.y));
  }
  CHECK(worst_m < 0.01);
}
