#include <chrono>
#include <cstdio>
#include <algorithm>
#include <cmath>
#include <random>
#include <gtest/gtest.h>
#include "base/image_io.h"
#include "base/parallel.h"
#include "lighting/environment_light.h"
#include "lighting/cube.h"
#include "lighting/equirect.h"
#include "lighting/prefilter.h"
#include "shading/shading.h"
using namespace parity;
using namespace parity::lighting;
static double now(){return (double)clock()/CLOCKS_PER_SEC;}
TEST(P,p){
  for(const char*f:{"studio_small_05_1k","st_peters_square_night_1k","chinese_garden_1k"}){
    scenes::Environment e; e.radiance=base::readImage(std::string(getenv("PARITY_SHARED"))+"/assets/env/"+f+".hdr");
    if(e.radiance.channels!=3){printf("ch %d\n",e.radiance.channels);}
    double t=now(); auto b=resampleEquirect(e,256); double t1=now();
    CubeSampler cs(b,256); double t2=now();
    // energy
    double se=0; int W=e.radiance.width,H=e.radiance.height; for(int y=0;y<H;y++){double h=(cos(M_PI*y/H)-cos(M_PI*(y+1)/H))*2*M_PI/W; for(int x=0;x<W;x++) se+=h*e.radiance.at(x,y)[1];}
    auto om=texelSolidAngles(256); double sc=0; for(int f2=0;f2<6;f2++)for(int i=0;i<65536;i++) sc+=om[i]*b[f2*65536+i].y;
    printf("%s resample %.1f ms sampler %.1f ms energy ratio %.6f\n",f,(t1-t)*1e3,(t2-t1)*1e3,sc/se);
    // truth: brute-force over cube texels at random texels
    auto sa=om;
    for(int m=1;m<=5;m++){
      double R=shading::f64::roughnessFromMip(m),al=R*R; int n=256>>m;
      double t3=now(); auto s=makeLobeSamples(R,samplesOfMip(m,128),256); auto mip=prefilterMip(cs,s,n); double t4=now();
      std::mt19937 g(1); std::vector<double> tr,ap;
      std::vector<double> rel; double se2=0,st2=0;
      const int NP=160;
      std::vector<glm::dvec3> T(NP),A(NP);
      std::vector<int> F(NP),X(NP),Y(NP); for(int i=0;i<NP;i++){F[i]=g()%6;X[i]=g()%n;Y[i]=g()%n;}
      base::parallelFor(NP,1,[&](size_t i,size_t){
        auto N=texelDirection(F[i],X[i],Y[i],n); glm::dvec3 s3(0);double w=0;
        for(int f2=0;f2<6;f2++)for(int y=0;y<256;y++)for(int x=0;x<256;x++){
          auto L=texelDirection(f2,x,y,256); double nl=dot(N,L); if(nl<=0)continue; double nh=sqrt((1+nl)/2);
          // low roughness: 3x3 subsamples
          double ww=shading::f64::D_GGX(al,nh)*nl*sa[y*256+x];
          if(m<=2&&nl>.9){ww=0; for(int a=0;a<3;a++)for(int c=0;c<3;c++){auto L2=glm::normalize(directionOf({f2,(2*(x+(a+.5)/3))/256-1,(2*(y+(c+.5)/3))/256-1})); double nl2=dot(N,L2); ww+=shading::f64::D_GGX(al,sqrt((1+nl2)/2))*nl2*sa[y*256+x]/9;}}
          s3+=ww*glm::dvec3(b[texelIndex(f2,x,y,256)]); w+=ww;}
        T[i]=s3/w; A[i]=glm::dvec3(mip[texelIndex(F[i],X[i],Y[i],n)]);
      });
      for(int i=0;i<NP;i++){double d=0,q=0;for(int c=0;c<3;c++){d+=pow(A[i][c]-T[i][c],2);q+=T[i][c]*T[i][c];} se2+=d;st2+=q; rel.push_back(sqrt(d/q));}
      std::sort(rel.begin(),rel.end());
      printf("  m%d R=%.3f  rmse %.2f%%  median rel %.2f%% p95 %.1f%% max %.1f%%   %.1f ms\n",m,R,100*sqrt(se2/st2),100*rel[NP/2],100*rel[NP*95/100],100*rel.back(),(t4-t3)*1e3);
    }
  }
}
