/* Lights of every kind from C: they change, some go, and samples are printed as words, which are those of Rust. */
#include "lightbvh.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LAMPS 100
#define PANEL 200
#define POINTS 1000

/* Ends the program where a call fails. */
static void must(lightbvh_status status)
{
    if (status != LIGHTBVH_OK) {
        fprintf(stderr, "lightbvh: status %d: %s\n", (int)status, lightbvh_last_error());
        exit(1);
    }
}

static uint32_t bits(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static lightbvh_transform at(float x, float y, float z)
{
    lightbvh_transform transform = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {x, y, z}};
    return transform;
}

/* Lamp `k`, 3 m above the ground; each kind in turn. */
static lightbvh_light lamp(int k)
{
    lightbvh_light light;
    float x = (float)k;
    memset(&light, 0, sizeof light);
    light.kind = (uint32_t)(k % 6);
    light.p[0] = x;
    light.p[1] = 3;
    light.emission[0] = 9;
    light.emission[1] = 8;
    light.emission[2] = 0.5f * (float)(k % 8);
    switch (light.kind) {
    case LIGHTBVH_TRIANGLE:
        light.a[0] = x + 0.25f;
        light.a[1] = light.b[1] = 3;
        light.b[0] = x;
        light.b[2] = 0.25f;
        break;
    case LIGHTBVH_POINT:
        light.range = 25;
        break;
    case LIGHTBVH_SPOT:
        light.a[1] = -1;
        light.inner = 0.25f;
        light.outer = 0.75f;
        light.range = 15;
        break;
    case LIGHTBVH_SPHERE:
        light.radius = 0.125f;
        break;
    default:
        light.a[0] = 0.25f;
        light.b[2] = 0.5f;
        light.flags = LIGHTBVH_TWO_SIDED;
    }
    return light;
}

/* A row of triangles, in another order for each frame. */
static void arrange(lightbvh_light *panel, int frame)
{
    int k;
    for (k = 0; k < PANEL; k++) {
        float x = 0.5f * (float)(k * frame % 199);
        panel[k] = lamp(0);
        panel[k].p[0] += x;
        panel[k].a[0] += x;
        panel[k].b[0] += x;
    }
}

/* Density over solid angle of a hit at `sampled`, as it is calculated on devices: lightbvh_kernel_id. */
static float density(const lightbvh_sampled *sampled, float pmf, const lightbvh_light_point *on)
{
    const float *d = sampled->direction, *n = sampled->point.normal;
    float cosine = -(d[0] * n[0] + d[1] * n[1] + d[2] * n[2]);
    if (on->flags & LIGHTBVH_TWO_SIDED && cosine < 0) {
        cosine = -cosine;
    }
    return cosine > 0 ? pmf * on->density * sampled->distance * sampled->distance / cosine : 0;
}

int main(void)
{
    lightbvh *bvh = lightbvh_create(LIGHTBVH_MASKED_LIGHTS), *again;
    lightbvh_light lights[LAMPS], panel[PANEL], other;
    lightbvh_edit edits[LAMPS];
    lightbvh_id lamps[LAMPS], mesh, instance, id;
    lightbvh_status statuses[2];
    lightbvh_point points[POINTS];
    lightbvh_sampled_light samples[POINTS];
    uint64_t randoms[POINTS];
    uint32_t first, count, part, *words;
    lightbvh_frame_start start;
    lightbvh_range removed[4];
    size_t size, failed = 0;
    unsigned trees = 0;
    int k, frame;

    if (bvh == NULL) {
        fprintf(stderr, "lightbvh: %s\n", lightbvh_last_error());
        return 1;
    }
    /* Lights by themselves, in one batch; one more by a call of its own. */
    for (k = 0; k < LAMPS - 1; k++) {
        lights[k] = lamp(k);
        edits[k] = lightbvh_edit_of(LIGHTBVH_ADD_LIGHT);
        edits[k].lights = &lights[k];
        if (k % 3 == 0) {
            edits[k].mask = 1;
        }
    }
    must(lightbvh_apply(bvh, edits, LAMPS - 1, lamps, NULL));
    lights[k] = lamp(k);
    must(lightbvh_add_light(bvh, &lights[k], &lamps[k]));
    must(lightbvh_refit(bvh));

    /* A frame later: one rises, one gets another colour, one other receivers, one is another light, and one goes. */
    must(lightbvh_set_transform(bvh, lamps[40], at(0, 2, 0)));
    must(lightbvh_set_radiance(bvh, lamps[41], 0.5f, 0.25f, 0.125f));
    must(lightbvh_set_mask(bvh, lamps[43], 2));
    other = lamp(1);
    must(lightbvh_set_light(bvh, lamps[44], &other));
    must(lightbvh_remove(bvh, lamps[42]));
    must(lightbvh_refit(bvh));

    /* What was kept of the light that went is replaced; then its number may be another's. */
    must(lightbvh_removed_lights(bvh, removed, 4, &size));
    for (k = 0; k < (int)size && k < 4; k++) {
        printf("%u lights from %u on are no more\n", (unsigned)removed[k].count, (unsigned)removed[k].first);
    }
    must(lightbvh_forget_removed_lights(bvh));

    /* The triangles of a panel change places in each frame, so its tree is rebuilt in the background. If runs need not
     * be bit-identical, leave out lightbvh_swap_after: then no frame waits. */
    must(lightbvh_swap_after(bvh, 1));
    arrange(panel, 1);
    must(lightbvh_add_mesh(bvh, panel, PANEL, &mesh));
    must(lightbvh_add_instance(bvh, mesh, at(0, 1, 4), &instance));
    edits[0] = lightbvh_edit_of(LIGHTBVH_ADD_INSTANCE);
    edits[0].id = mesh;
    edits[0].transform.translation[2] = -4;
    must(lightbvh_apply(bvh, edits, 1, NULL, NULL));
    for (frame = 1; frame <= 30; frame++) {
        must(lightbvh_begin_frame(bvh, &start));
        trees += start.swapped + start.meshes;
        arrange(panel, frame);
        must(lightbvh_set_lights(bvh, mesh, 0, panel, PANEL));
        must(lightbvh_refit(bvh));
        must(lightbvh_end_frame(bvh));
    }
    printf("%u trees were built\n", trees);
    must(lightbvh_lights_of(bvh, instance, &first, &count));
    printf("the panel has lights from %u on, %u of them\n", (unsigned)first, (unsigned)count);
    must(lightbvh_rebuild(bvh));

    /* Kept in a file and read again, it has the same indices, and ids of its own. */
    must(lightbvh_words(bvh, NULL, 0, &size));
    words = malloc(size * sizeof *words);
    must(lightbvh_words(bvh, words, size, &size));
    again = lightbvh_create_from_words(LIGHTBVH_MASKED_LIGHTS, words, size);
    free(words);
    if (again == NULL) {
        fprintf(stderr, "lightbvh: %s\n", lightbvh_last_error());
        return 1;
    }
    must(lightbvh_mesh_at(again, mesh.index, &id));
    must(lightbvh_instance_at(again, instance.index, &id));

    /* Samples of a row of points on the ground, as words. */
    for (k = 0; k < POINTS; k++) {
        lightbvh_point point = {{0.125f * (float)k, 0, 0.5f}, {0, 1, 0}, 3};
        points[k] = point;
        points[k].mask = (uint32_t)(k % 3 + 1);
        randoms[k] = UINT64_C(0x9e3779b97f4a7c15) * (uint64_t)(k + 1);
    }
    must(lightbvh_sample_batch(bvh, points, randoms, POINTS, samples));
    for (k = 0; k < POINTS; k++) {
        lightbvh_sampled_light one;
        lightbvh_sampled sampled;
        lightbvh_light_point on;
        float pmf, pmf_of, pdf, expected;
        must(lightbvh_sample(again, &points[k], randoms[k], &one));
        must(lightbvh_pmf(bvh, &points[k], one.light, one.instance, &pmf));
        must(lightbvh_owner(bvh, one.light, one.instance, &id, &part));
        must(lightbvh_pmf_of(bvh, &points[k], id, part, &pmf_of));
        must(lightbvh_point_of(bvh, &points[k], one.light, one.instance, 0.25f, 0.5f, &on));
        must(lightbvh_sample_light(bvh, &points[k], randoms[k], 0.25f, 0.5f, &sampled));
        must(lightbvh_pdf_of_hit(bvh, &points[k], id, part, on.p, &pdf));
        if (memcmp(&one, &samples[k], sizeof one) != 0 || bits(pmf) != bits(one.pmf) || bits(pmf_of) != bits(pmf) ||
            memcmp(&id, &sampled.instance, sizeof id) != 0 || part != sampled.part ||
            memcmp(&on, &sampled.point, sizeof on) != 0) {
            fprintf(stderr, "point %d: two functions differ\n", k);
            return 1;
        }
        must(lightbvh_point_of(bvh, &points[k], one.light, one.instance, 0.75f, 0, &on));
        expected = density(&sampled, pmf, &on);
        if (pdf < 0.999f * expected || pdf > 1.001f * expected) {
            fprintf(stderr, "point %d: another density than on devices\n", k);
            return 1;
        }
        printf("%" PRIu32 " %" PRIu32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 "\n",
               one.light, one.instance, bits(pmf), bits(pdf), bits(sampled.pdf),
               bits(lightbvh_mis_weight(sampled.pdf, 0.25f)), bits(sampled.irradiance[0]));
    }

    /* What is wrong is refused, with a sentence: all of a batch, or it alone. */
    edits[0] = lightbvh_edit_of(LIGHTBVH_SET_RADIANCE);
    edits[0].id = lamps[41];
    edits[0].radiance[0] = 2;
    edits[1] = edits[0];
    edits[1].id = lamps[42];
    if (lightbvh_apply(bvh, edits, 2, NULL, &failed) != LIGHTBVH_UNKNOWN_INSTANCE || failed != 1 ||
        lightbvh_apply_each(bvh, edits, 2, NULL, statuses) != LIGHTBVH_UNKNOWN_INSTANCE || statuses[0] != LIGHTBVH_OK ||
        statuses[1] != LIGHTBVH_UNKNOWN_INSTANCE || lightbvh_remove(bvh, mesh) != LIGHTBVH_IN_USE) {
        fprintf(stderr, "a wrong edit was done\n");
        return 1;
    }
    printf("%s\n", lightbvh_last_error());
    lightbvh_free(again);
    lightbvh_free(bvh);
    return 0;
}
