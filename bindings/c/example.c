/* Opens a scene, renders a frame of its flight, lets it rain, and has a thread of the library render
 * the poses that follow; the newest B-scope becomes bscope.pgm.
 *
 *   example SHIPPED SCENE      share/fanbeam below the prefix, and a scene folder with a flight
 *
 *   cc -std=c99 example.c $(pkg-config --cflags --libs fanbeam) -o example */
#define _POSIX_C_SOURCE 199309L /* nanosleep */
#include <fanbeam/fanbeam.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Prints what the last call had to say; an error ends the program. */
static void check(const char* what, fanbeam_status status) {
  if (*fanbeam_last_warnings() != '\0') fprintf(stderr, "%s\n", fanbeam_last_warnings());
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", what, fanbeam_last_error());
  exit(3);
}

int main(int argc, char** argv) {
  const struct timespec nap = {0, 1000000};
  const fanbeam_weather rain = {
      .size = sizeof rain, .given = FANBEAM_RAIN_RATE, .rain_rate_mm_per_h = 10.0};
  fanbeam_setup setup = {.size = sizeof setup};
  fanbeam_facts facts = {.size = sizeof facts};
  fanbeam_pose pose = {.size = sizeof pose};
  fanbeam_frame frame = {.size = sizeof frame};
  fanbeam_output output = {.size = sizeof output};
  fanbeam_session* session = NULL;
  FILE* file;
  int i;
  if (argc != 3) {
    fprintf(stderr, "usage: example SHIPPED SCENE\n");
    return 2;
  }
  setup.shipped_folder = argv[1];
  check(argv[2], fanbeam_open(argv[2], &setup, &session));
  check("facts", fanbeam_get_facts(session, &facts));
  check("first pose", fanbeam_flown_pose(session, 0, &pose));
  output.bscope_count = (size_t)facts.columns * facts.bscope_rows;
  output.bscope = malloc(output.bscope_count);
  if (output.bscope == NULL) return 1;
  check("render", fanbeam_render(session, &pose, 0, &output)); /* at once */
  check("weather", fanbeam_set_weather(session, &rain));
  for (i = 0; i < 5; ++i) { /* without waiting: the newest wins */
    pose.height_m += 1.0;
    check("submit", fanbeam_submit_pose(session, &pose));
  }
  while (frame.height_m != pose.height_m) { /* a simulator looks once in each frame of its own */
    nanosleep(&nap, NULL);
    check("latest", fanbeam_latest_frame(session, &frame, output.bscope, output.bscope_count, NULL,
                                         0));
  }
  printf("frame %lu in %.1f ms\n", (unsigned long)frame.number, 1e3 * frame.render_s);
  fanbeam_close(session);
  if ((file = fopen("bscope.pgm", "wb")) == NULL) return 1;
  fprintf(file, "P5\n%u %u\n255\n", (unsigned)facts.columns, (unsigned)facts.bscope_rows);
  fwrite(output.bscope, facts.columns, facts.bscope_rows, file);
  free(output.bscope);
  return fclose(file) != 0;
}
